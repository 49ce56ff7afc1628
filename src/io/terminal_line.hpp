/// \file
/// A line on standard error that is drawn repeatedly.
#pragma once

#include <string>

namespace io {

/// Whether standard error is a terminal that can clear a line.
[[nodiscard]] bool can_redraw_line();

/// Replaces the line by the text, cut to the width of the terminal; an empty text clears it. Errors
/// are ignored: a line that cannot be drawn is no reason to stop the work.
void redraw_line(std::string text);

}  // namespace io
