#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace subimpact {

/// The kinds of errors; each has its type below.
enum class ErrorKind { invalid_case, case_file, results, output, directory_in_use };

/// An error that a user can correct. `what()` states what is wrong, what is allowed and what to do.
class Error : public std::runtime_error {
 public:
  Error(const std::string& message, ErrorKind kind) : std::runtime_error(message), kind(kind) {}
  ErrorKind kind;
};

/// The errors of one kind, and of the kinds derived from it, to be caught by type.
template <ErrorKind of, class Base = Error>
class ErrorOf : public Base {
 public:
  explicit ErrorOf(const std::string& message, ErrorKind kind = of) : Base(message, kind) {}
};

/// Settings that cannot be run as given. `key` is the key of the case file ("solver.step"), with
/// which `what()` begins; `message` is what follows.
class InvalidCase : public Error {
 public:
  InvalidCase(const std::string& key, std::string message)
      : Error(key + ' ' + message, ErrorKind::invalid_case),
        key(key),
        message(std::move(message)) {}
  std::string key, message;
};

/// A case that cannot be read. `what()` has one line per problem, with place, key, what is wrong,
/// what is allowed and what to do.
using CaseFileError = ErrorOf<ErrorKind::case_file>;

/// Files of a run that are missing or do not have the format of write_results(); `what()` names
/// file and line, what was found, and what to do.
using ResultsError = ErrorOf<ErrorKind::results>;

/// A file or directory that cannot be written; `what()` names it, the cause and what to do.
using OutputError = ErrorOf<ErrorKind::output>;

/// Another process writes into the directory.
using DirectoryInUse = ErrorOf<ErrorKind::directory_in_use, OutputError>;

}  // namespace subimpact
