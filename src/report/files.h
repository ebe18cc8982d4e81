#pragma once

#include <string_view>

namespace subimpact {

/// The text of a file of this folder, "pages/web/page.html" for example, from within the library.
/// Throws std::logic_error for a file that the build does not list.
std::string_view embedded_file(std::string_view name);

}  // namespace subimpact
