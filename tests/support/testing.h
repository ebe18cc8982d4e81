#pragma once

/// What tests of every folder include: GoogleTest, the usual headers of the standard library, and
/// claims about texts and refusals.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace subimpact {

/// Each of these pieces stands in the text.
template <class... Pieces>
void expect_in(const std::string& text, const Pieces&... pieces) {
  for (const std::string& piece : std::initializer_list<std::string>{pieces...}) {
    EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in:\n"
                                                   << text.substr(0, 10'000);
  }
}

/// Each piece of "this|that" does.
inline void expect_all_in(const std::string& text, const std::string& pieces) {
  std::istringstream all(pieces);
  for (std::string piece; std::getline(all, piece, '|');) expect_in(text, piece);
}

/// None of these pieces stands in the text.
template <class... Pieces>
void expect_not_in(const std::string& text, const Pieces&... pieces) {
  for (const std::string& piece : {std::string(pieces)...}) {
    EXPECT_EQ(text.find(piece), std::string::npos) << '"' << piece << "\" is in:\n"
                                                   << text.substr(0, 10'000);
  }
}

inline std::size_t count_in(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != text.npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

/// Numbers that agree one by one, within an absolute error and one relative to what is expected.
template <class Found, class Expected>
void expect_near(const Found& found, const Expected& expected, double absolute,
                 double relative = 0.0) {
  ASSERT_EQ(std::size(found), std::size(expected));
  for (std::size_t i = 0; i < std::size(found); ++i) {
    EXPECT_NEAR(found[i], expected[i], absolute + relative * std::abs(expected[i])) << i;
  }
}

/// The message of the exception that a call throws; "(accepted)" if it throws none.
template <class Error, class Call>
std::string answer_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "(accepted)";
}

/// The same; a failure if it throws none.
template <class Error, class Call>
std::string message_of(const Call& call) {
  const std::string message = answer_of<Error>(call);
  EXPECT_NE(message, "(accepted)");
  return message;
}

}  // namespace subimpact
