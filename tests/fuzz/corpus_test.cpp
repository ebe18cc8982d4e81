#include "targets.h"
#include "testing.h"

namespace subimpact::fuzz {
namespace {

namespace fs = std::filesystem;

struct Target {
  const char* name;
  void (*run)(Bytes);
};

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class TheCorpus : public testing::TestWithParam<Target> {};

TEST_P(TheCorpus, IsReadOrRefusedWithoutACrash) {
  int n = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SUBIMPACT_CORPUS) / GetParam().name)) {
    SCOPED_TRACE(entry.path().filename().string());
    const std::vector<std::uint8_t> bytes = bytes_of(entry.path());
    EXPECT_NO_THROW(GetParam().run(bytes));
    // Half an input is another one.
    EXPECT_NO_THROW(GetParam().run(Bytes(bytes).first(bytes.size() / 2)));
    ++n;
  }
  EXPECT_GT(n, 4);
}

INSTANTIATE_TEST_SUITE_P(Of, TheCorpus,
                         testing::Values(Target{"case_text", case_text},
                                         Target{"structured_case", structured_case}),
                         [](const auto& info) { return std::string(info.param.name); });

// Bytes of a congruential generator, the same everywhere: 300 lots of at least so many.
void run_on_any_bytes(void (*run)(Bytes), std::uint32_t state, int least, int spread) {
  for (int i = 0; i < 300; ++i) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(least + i % spread));
    for (std::uint8_t& byte : bytes) {
      state = 1664525U * state + 1013904223U;
      byte = static_cast<std::uint8_t>(state >> 24);
    }
    EXPECT_NO_THROW(run(bytes)) << i;
  }
}

TEST(StructuredCases, OfAnyBytesAreRefusedOrRunSoundly) {
  run_on_any_bytes(structured_case, 1, 8, 40);
}

}  // namespace
}  // namespace subimpact::fuzz
