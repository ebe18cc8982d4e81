#include "io/directory/listed_files.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "io/records/record.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

constexpr int manifest_layout = 1, deepest = 16;
const std::string staging_prefix = ".subimpact-";
constexpr std::size_t n_identity = 32;  // digits
constexpr const char* hexadecimal = "0123456789abcdef";

Json fingerprints_to_json(const std::map<std::string, Fingerprint>& fingerprints) {
  Json json = Json::object();
  for (const auto& [name, fingerprint] : fingerprints) {
    json[name] = {{"bytes", fingerprint.bytes}, {"sha256", fingerprint.sha256}};
  }
  return json;
}

// Names are those of files in the directory itself: a manifest from elsewhere must not lead out.
std::map<std::string, Fingerprint> fingerprints_from(const Json& json) {
  std::map<std::string, Fingerprint> fingerprints;
  for (const auto& [name, entry] : json.items()) {
    if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) {
      fail<ResultsError>("\"{}\" is not the name of a file of results", name);
    }
    fingerprints[name] = {integer<std::uintmax_t>(entry.at("bytes")),
                          entry.at("sha256").get<std::string>()};
  }
  return fingerprints;
}

[[noreturn]] void refuse_to_read(const fs::path& path, const char* cause) {
  fail<ResultsError>("{}: cannot be read ({}); give the output directory of `subimpact run`",
                     path.string(), cause);
}

}  // namespace

Fingerprint fingerprint_of(std::istream& file) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        EVP_MD_CTX_free);
  EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
  Fingerprint fingerprint;
  std::array<char, 1 << 16> buffer;
  while (file.read(buffer.data(), buffer.size()), file.gcount() > 0) {
    const auto n = static_cast<std::size_t>(file.gcount());
    EVP_DigestUpdate(context.get(), buffer.data(), n);
    fingerprint.bytes += n;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int length = 0;
  EVP_DigestFinal_ex(context.get(), digest.data(), &length);
  for (unsigned int i = 0; i < length; ++i) fingerprint.sha256 += fmt::format("{:02x}", digest[i]);
  return fingerprint;
}

fs::path staging_of(const fs::path& directory, const std::string& commit) {
  return directory / (staging_prefix + commit);
}

bool is_staging(const std::string& name) {
  const std::size_t n_prefix = staging_prefix.size();
  return name.size() == n_prefix + n_identity && name.starts_with(staging_prefix) &&
         name.find_first_not_of(hexadecimal, n_prefix) == std::string::npos;
}

std::optional<Manifest> read_manifest(const fs::path& directory) {
  const fs::path path = directory / manifest_name;
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return {};
  const std::string text = read_whole_file(path);
  // Copies of deeply nested values exhaust the stack.
  const auto refuse_deep_nesting = [](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) fail<ResultsError>("is nested deeper than {}", deepest);
    return true;
  };
  try {
    const Json json = Json::parse(text, refuse_deep_nesting);
    if (integer<int>(json.at("subimpact_manifest")) > manifest_layout) {
      throw ResultsError("a later version of this program wrote it; use that version");
    }
    const auto word = [&](const char* name) { return json.at(name).get<std::string>(); };
    Manifest manifest = {word("kind"), word("identity"), word("commit"),
                         fingerprints_from(json.at("files")),
                         fingerprints_from(json.at("replaced"))};
    if (manifest.commit.find_first_not_of(hexadecimal) != std::string::npos) {
      throw ResultsError("\"commit\" is not a hexadecimal number");
    }
    return manifest;
  } catch (const ResultsError& error) {
    fail<ResultsError>("{}: {}", path.string(), error.what());
  } catch (const std::exception& error) {  // of JSON
    fail<ResultsError>("{}: is not a manifest of this program ({})", path.string(), error.what());
  }
}

std::string to_json(const Manifest& manifest) {
  const Json json = {{"subimpact_manifest", manifest_layout},
                     {"kind", manifest.kind},
                     {"identity", manifest.identity},
                     {"program", "subimpact " + project_version()},
                     {"commit", manifest.commit},
                     {"files", fingerprints_to_json(manifest.files)},
                     {"replaced", fingerprints_to_json(manifest.replaced)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string read_whole_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {  // a pipe or a device may never end
    refuse_to_read(path, "it is no regular file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const std::istreambuf_iterator<char> begin(file), end;
  std::string text(begin, end);
  if (!file) refuse_to_read(path, std::strerror(errno));
  return text;
}

}  // namespace subimpact
