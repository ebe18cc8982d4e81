#pragma once

#include <string>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// The key and the message with which a call refuses a case; empty if it accepts it.
struct Refusal {
  std::string key, message;
};

template <class Call>
requires std::is_invocable_v<Call> Refusal refusal_of(const Call& call) {
  try {
    call();
  } catch (const InvalidCase& error) {
    return {error.key, error.message};
  }
  return {};
}

}  // namespace subimpact
