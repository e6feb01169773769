// Numbers and words beside the colour scale.
#include "render/legend.h"

#include <catch2/catch.hpp>
#include <limits>

#include "render/stroke_font.h"
#include "render/text.h"
#include "render/ticks.h"

using namespace curlew;

using Strings = std::vector<std::string>;

TEST_CASE("ticks are round numbers inside the range") {
  CHECK(round_ticks({0, 3.4}, 7).text == Strings{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"});
  CHECK(round_ticks({0, 3.4}, 4).text == Strings{"0", "1", "2", "3"});
  CHECK(round_ticks({-10, 10}, 5).text == Strings{"-10", "-5", "0", "5", "10"});
  CHECK(round_ticks({0.31, 0.39}, 5).text == Strings{"0.32", "0.34", "0.36", "0.38"});
  CHECK(round_ticks({0, 1}, 3).text == Strings{"0.0", "0.5", "1.0"});
  CHECK(round_ticks({1000, 1010}, 3).text == Strings{"1000", "1005", "1010"});
}

TEST_CASE("large and small numbers share a power of ten") {
  const Ticks pascal = round_ticks({0, 45000}, 5);
  CHECK(pascal.exponent == 3);
  CHECK(pascal.text == Strings{"0", "10", "20", "30", "40"});
  CHECK(pascal.at[1] == Approx(10000));
  const Ticks error = round_ticks({0, 2.5e-4}, 4);
  CHECK(error.exponent == -6);
  CHECK(error.text == Strings{"0", "100", "200"});
}

TEST_CASE("ticks stay few and exist for any range") {
  for (const double span : {1e-12, 0.013, 1.0, 7.7, 123.0, 9.9e20})
    for (int most = 2; most < 9; ++most) {
      const Ticks ticks = round_ticks({-0.3 * span, 0.7 * span}, most);
      CHECK(static_cast<int>(ticks.at.size()) <= most);
      CHECK_FALSE(ticks.at.empty());
      for (const double at : ticks.at) CHECK((at >= -0.3001 * span && at <= 0.7001 * span));
    }
  CHECK(round_ticks({1, 1}, 5).at.empty());
  CHECK(round_ticks({0, std::numeric_limits<double>::infinity()}, 5).at.empty());
}

TEST_CASE("the title has the label, a power of ten and the unit where there are any") {
  CHECK(legend_title({"speed", "speed", "m/s"}, 0) == "speed (m/s)");
  CHECK(legend_title({"pressure", "pressure", "Pa"}, 3) == "pressure (10^3 Pa)");
  CHECK(legend_title({"error", "density error", "1"}, 0) == "density error");
  CHECK(legend_title({"error", "density error", "1"}, -6) == "density error (10^-6)");
}

TEST_CASE("every printable sign has a shape of its own") {
  const auto is_box = [](const StrokeGlyph& g) {
    return g.strokes.size() == 1 && g.strokes[0].size() == 5 && g.width == stroke_glyph(0xfffd).width;
  };
  for (std::uint32_t c = '!'; c < 127; ++c) {
    if (c == '$' || c == '@' || c == '`' || c == '{' || c == '}') continue;  // not in any unit; an empty box
    const StrokeGlyph glyph = stroke_glyph(c);
    INFO(static_cast<char>(c));
    CHECK_FALSE(glyph.strokes.empty());
    CHECK_FALSE(is_box(glyph));
  }
}

TEST_CASE("text is laid out from left to right, figures take equal room, powers stand higher") {
  const FontAtlas font(10);
  CHECK(font.width_of("11111") == Approx(font.width_of("80808")));
  CHECK(font.width_of("m/s") > font.width_of("m"));
  CHECK(font.width_of("") == 0);
  const TextLine line = font.lay_out("m^3x", 100, 50);
  REQUIRE(line.glyphs.size() == 3);  // the sign ^ itself is not drawn
  CHECK(line.glyphs[0].x < line.glyphs[1].x);
  CHECK(line.glyphs[1].x < line.glyphs[2].x);
  const auto bottom = [](const PlacedGlyph& g) { return g.y + g.glyph->height; };
  CHECK(bottom(line.glyphs[1]) < bottom(line.glyphs[0]));
  CHECK(bottom(line.glyphs[2]) == bottom(line.glyphs[0]));
  CHECK_NOTHROW(font.lay_out("\xff\xc3 \xe2\x82", 0, 0));  // not UTF-8: boxes, no crash
}
