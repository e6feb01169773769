// How the interface looks: font, sizes and the two themes.
#pragma once

#include <string>

namespace curlew {

// Sets fonts and sizes for a display scale (1 for a usual screen, 2 for a dense one), and the colours. Call between
// frames; a font change needs the backend's font texture made anew, which the next frame does.
void set_style(bool dark, double scale);

// Begins a window of a fixed place and size (pixels), without a title. ImGui::End() ends it.
void begin_panel(const char* name, float x, float y, float width, float height, int flags = 0);

// The next button, or check box, goes beside the last widget where there is room for its label.
void same_line_if_fits(const char* label, bool check_box = false);

// Of a slider with its name beside it: in a narrow panel the names need the room.
float slider_width();

// A paper's symbol as it is written by hand: "nu" becomes the Greek letter where the font has it.
std::string written_symbol(const std::string& symbol);
// "m^2/s" with a raised 2.
std::string written_unit(const std::string& unit);

}  // namespace curlew
