#include "app/gui/style.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace curlew {
namespace {

// Where distributions put DejaVu Sans. Without it Dear ImGui's own font serves, which has no Greek.
constexpr const char* font_files[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
};

constexpr ImGuiWindowFlags panel_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

bool has_greek = false;

void load_font(double scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  has_greek = false;
  // Latin, Greek, subscripts, and the few signs that we use.
  static const ImWchar ranges[] = {0x20,   0xFF,   0x370,  0x3FF,  0x2013, 0x2026, 0x1D68,
                                   0x1D68, 0x2080, 0x209C, 0x25A0, 0x25FF, 0};
  for (const char* file : font_files) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    if (fonts.AddFontFromFileTTF(file, static_cast<float>(14.0 * scale), nullptr, ranges) != nullptr) {
      has_greek = true;
      return;
    }
  }
  ImFontConfig config;
  config.SizePixels = static_cast<float>(13.0 * scale);
  fonts.AddFontDefault(&config);
}

}  // namespace

void set_style(bool dark, double scale) {
  ImGuiStyle style;
  if (dark) {
    ImGui::StyleColorsDark(&style);
  } else {
    ImGui::StyleColorsLight(&style);
  }
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = dark ? 0.0f : 1.0f;
  style.WindowPadding = {10, 8};
  style.ItemSpacing = {7, 5};
  style.IndentSpacing = 12;
  style.ScrollbarSize = 12;
  style.Colors[ImGuiCol_WindowBg] = dark ? ImVec4(0.11f, 0.12f, 0.14f, 1) : ImVec4(0.955f, 0.96f, 0.97f, 1);
  style.Colors[ImGuiCol_PopupBg] = dark ? ImVec4(0.15f, 0.16f, 0.19f, 1) : ImVec4(1, 1, 1, 1);
  style.GrabMinSize = 8;
  // The number under a slider's grab stays readable.
  const float see_through = 0.55f;
  const ImVec4 accent = dark ? ImVec4(0.26f, 0.55f, 0.82f, 1) : ImVec4(0.16f, 0.46f, 0.74f, 1);
  style.Colors[ImGuiCol_CheckMark] = style.Colors[ImGuiCol_SliderGrabActive] = style.Colors[ImGuiCol_SliderGrab] =
      accent;
  style.Colors[ImGuiCol_SliderGrab].w = style.Colors[ImGuiCol_SliderGrabActive].w = see_through;
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
  static double loaded = 0;
  if (loaded != scale || !ImGui::GetIO().Fonts->IsBuilt()) load_font(scale);
  loaded = scale;
}

void begin_panel(const char* name, float x, float y, float width, float height, int flags) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, panel_flags | flags);
}

void same_line_if_fits(const char* label, bool check_box) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float around = check_box ? ImGui::GetFrameHeight() + style.ItemInnerSpacing.x : 2 * style.FramePadding.x;
  const float wide = ImGui::CalcTextSize(label).x + around + style.ItemSpacing.x;
  const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + wide < end) ImGui::SameLine();
}

float slider_width() {
  const float em = ImGui::GetFontSize();
  return std::clamp(ImGui::GetContentRegionAvail().x - 13.5f * em, 4 * em, 9.5f * em);
}

std::string written_symbol(const std::string& symbol) {
  if (!has_greek) return symbol;
  static const std::map<std::string, std::string> letters = {
      {"alpha", "\u03b1"}, {"gamma", "\u03b3"}, {"epsilon", "\u03b5"}, {"zeta", "\u03b6"},
      {"eta", "\u03b7"},   {"Theta", "\u0398"}, {"nu", "\u03bd"},      {"rho", "\u03c1"},
      {"tau", "\u03c4"},   {"omega", "\u03c9"}, {"psi", "\u03c8"},
  };
  const auto underscore = symbol.find('_');
  const std::string base = symbol.substr(0, underscore);
  const auto letter = letters.find(base);
  std::string text = letter == letters.end() ? base : letter->second;
  if (underscore == std::string::npos) return text;
  const std::string below = symbol.substr(underscore + 1);
  const std::string digits = "0123456789";
  if (below.size() == 1 && digits.find(below) != std::string::npos) {
    const std::string subscripts[] = {"\u2080", "\u2081", "\u2082", "\u2083", "\u2084",
                                      "\u2085", "\u2086", "\u2087", "\u2088", "\u2089"};
    return text + subscripts[digits.find(below)];
  }
  // The few letters that have a small form below the line.
  static const std::map<std::string, std::string> subscripts = {{"t", "\u209c"}, {"rho", "\u1d68"}};
  const auto small = subscripts.find(below);
  return text + (small == subscripts.end() ? "_" + below : small->second);
}

std::string written_unit(const std::string& unit) {
  std::string text;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    if (unit[k] == '^' && k + 1 < unit.size() && (unit[k + 1] == '2' || unit[k + 1] == '3')) {
      text += unit[++k] == '2' ? "\u00b2" : "\u00b3";
    } else {
      text += unit[k];
    }
  }
  return text;
}

}  // namespace curlew
