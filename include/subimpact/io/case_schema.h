#pragma once

#include <string>

namespace subimpact {

/// The JSON schema (draft 2020-12) of a case file, made from case_keys(): for editors that complete
/// and check TOML, and for programs that write case files. It expresses what each key accepts by
/// itself; checks across keys stay with check(). A key that may be infinite also accepts null,
/// since JSON has no infinity and editors hand TOML's inf to the schema as null.
std::string case_schema();

}  // namespace subimpact
