#pragma once

#include <string>
#include <string_view>

namespace subimpact {

/// The text made safe for a terminal: control characters other than tabs and ends of lines (C0, DEL
/// and C1), and bytes that are not UTF-8, are shown as "\x1b". Text from files, paths and command
/// lines passes through here before it is printed.
std::string printable(std::string_view text);

}  // namespace subimpact
