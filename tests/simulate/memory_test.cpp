#include "simulate/run_parts.h"

#include "address_sanitizer.h"
#include "refusal.h"
#include "resource_limit.h"
#include "subimpact/simulate/result.h"
#include "subimpact/simulate/simulate.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& content) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << content;
}

/// The files of a machine with 8 GB free.
struct Machine : testing::Test {
  Machine() {
    write(directory.path / "proc/meminfo",
          "MemTotal:       16000000 kB\nMemFree:         100000 kB\n"
          "MemAvailable:    8000000 kB\n");
  }
  void set_group(const std::string& group, const std::string& most, const std::string& now,
                 const std::string& statistics = "") {
    const fs::path place = directory.path / "sys/fs/cgroup" / group;
    write(place / "memory.max", most + '\n');
    write(place / "memory.current", now + '\n');
    write(place / "memory.stat", statistics);
  }
  void enter_group(const std::string& group) {
    write(directory.path / "proc/self/cgroup", "0::/" + group + '\n');
  }
  double available() const { return available_memory(directory.path); }

  TemporaryDirectory directory;
};

using AvailableMemory = Machine;

TEST_F(AvailableMemory, IsWhatTheMachineAndItsControlGroupsLeave) {
  EXPECT_EQ(available(), 8192e6);
  enter_group("jobs/one");
  set_group("jobs/one", "3000000000", "1000000000");
  EXPECT_EQ(available(), 2e9);
  set_group("jobs/one", "max", "1000000000");
  set_group("jobs", "5000000000", "4000000000");
  EXPECT_EQ(available(), 1e9) << "of the group above";
  set_group("jobs", "max", "1000000000");
  EXPECT_EQ(available(), 8192e6) << "no limit";
  set_group("jobs", "3000000000", "2900000000", "anon 400000000\nfile 2500000000\nkernel 0\n");
  EXPECT_EQ(available(), 2.6e9) << "with the pages of files";
}

TEST_F(AvailableMemory, IsNoMoreThanTheLimitOfTheProcess) {
  const ResourceLimit limit(RLIMIT_AS, 1'000'000'000);
  EXPECT_EQ(available(), 1e9);
}

TEST_F(AvailableMemory, HasNoBoundWhereTheSystemShowsNone) {
  fs::remove_all(directory.path / "proc");
  EXPECT_TRUE(std::isinf(available()));
}

TEST(CheckMemory, RefusesARunThatTakesMoreThanThereIsAndNamesTheRemedy) {
  if (has_address_sanitizer) GTEST_SKIP() << "no limit of memory with the address sanitizer";
  ResolvedSettings settings;
  settings.n_unknowns = 20000;
  settings.memory = 3.2e9;
  const ResourceLimit limit(RLIMIT_AS, 1'000'000'000);
  const auto [key, message] = refusal_of([&] { check_memory(settings); });
  EXPECT_EQ(key, "solver.method");
  expect_in(message, "takes some 3.2 GB of memory on this mesh of 20000 unknowns",
            "the machine has 1 GB free", "use a coarser mesh");
  settings.memory = 1e6;
  EXPECT_NO_THROW(check_memory(settings));
}

}  // namespace
}  // namespace subimpact
