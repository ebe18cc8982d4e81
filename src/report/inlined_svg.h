#pragma once

#include <string>

namespace subimpact {

/// An SVG file as an element of an HTML page: without prologue and name spaces, its ids prefixed so
/// that several figures on a page do not share them.
std::string inlined_svg(const std::string& svg, const std::string& prefix);

}  // namespace subimpact
