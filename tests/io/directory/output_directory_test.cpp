#include "subimpact/io/output_directory.h"

#include <sys/stat.h>
#include <sstream>

#include "io/directory/listed_files.h"
#include "resource_limit.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using AFullDisk = InADirectory;
using AnOutputDirectory = InADirectory;

using Names = std::vector<std::string>;

// A directory's files of a kind, made by one writer.
void make(const fs::path& directory, const std::string& kind, const std::string& identity,
          const std::map<std::string, std::string>& all) {
  OutputDirectory files(directory, kind, identity);
  for (const auto& [name, content] : all) write_file(files.staging() / name, content);
  files.commit();
}

void commit(OutputDirectory& files, const std::string& name, const std::string& content) {
  write_file(files.staging() / name, content);
  files.commit();
}

// A file that the manifest lists, as a reader finds it: one that is not yet in its place waits
// under the name of its commit.
std::string listed_text(const fs::path& directory, const std::string& name) {
  const Manifest manifest = read_manifest(directory).value();
  for (const fs::path& place : {directory / name, staging_of(directory, manifest.commit) / name}) {
    if (!fs::exists(place)) continue;
    std::istringstream text(read_whole_file(place));
    if (fingerprint_of(text) == manifest.files.at(name)) return text.str();
  }
  return "not the file that the manifest lists";
}

std::string refusal_of(const fs::path& directory, const std::string& kind,
                       const std::string& identity = "1") {
  return answer_of<OutputError>([&] { OutputDirectory(directory, kind, identity); });
}

TEST_F(AnOutputDirectory, ThatIsNotCommittedIsLeftAsItWas) {
  for (const char* name : {"", "new"}) {  // which is there, and which is made
    {
      const OutputDirectory files(directory.path / name, "run");
      write_file(files.staging() / "events.csv", "1");
    }
    EXPECT_TRUE(fs::is_empty(directory.path)) << name;
  }
}

TEST_F(AnOutputDirectory, ThatCannotBeMadeIsRefusedWithTheCause) {
  directory.write("file", "x");
  expect_in(refusal_of(directory.path / "file", "run"), "cannot be made (Not a directory)");
  expect_in(refusal_of(directory.path / "file" / "below", "run"), "cannot be made");
  expect_in(refusal_of(directory.path / std::string(300, 'x'), "run"), "File name too long");
  fs::create_symlink("nothing", directory.path / "link");
  expect_in(refusal_of(directory.path / "link", "run"), "cannot be made (File exists)");
}

TEST_F(AnOutputDirectory, NamedByASymbolicLinkHasItsFilesInTheirPlaces) {
  fs::create_directory(directory.path / "real");
  fs::create_directory_symlink("real", directory.path / "link");
  for (const char* content : {"1", "2"}) {
    OutputDirectory files(directory.path / "link", "run");
    write_file(files.staging() / "events.csv", content);
    files.commit();
    EXPECT_EQ(directory.read("real/events.csv"), content);
  }
}

TEST_F(AnOutputDirectory, HasOneWriterAtATime) {
  {
    const OutputDirectory first(directory.path, "run");
    expect_in(refusal_of(directory.path, "run"), "another process is writing into this directory");
    EXPECT_THROW(OutputDirectory(directory.path, "run"), DirectoryInUse);
  }
  EXPECT_EQ(refusal_of(directory.path, "run"), "(accepted)");
}

TEST_F(AnOutputDirectory, LosesTheFilesOfTheRunBefore) {
  make(directory.path, "run", "1", {{"sections.csv", "old"}, {"events.csv", "old"}});
  make(directory.path, "figures", "1", {{"report.html", "page"}});
  OutputDirectory files(directory.path, "run");
  EXPECT_EQ(directory.read("events.csv"), "old");
  commit(files, "events.csv", "new");
  EXPECT_EQ(directory.read("events.csv"), "new");
  EXPECT_FALSE(directory.has("sections.csv"));
  EXPECT_FALSE(directory.has("report.html"));
}

TEST_F(AnOutputDirectory, KeepsFilesThatAreNotOfTheProgram) {
  directory.write("notes.txt", "mine");
  directory.write("transitions.csv", "mine");
  fs::create_symlink("notes.txt", directory.path / "summary.json");
  make(directory.path, "run", "1", {{"events.csv", "old"}});
  OutputDirectory files(directory.path, "run");
  for (const char* name : {"events.csv", "transitions.csv", "summary.json"}) {
    write_file(files.staging() / name, "new");
  }
  files.commit();
  EXPECT_EQ(directory.read("notes.txt"), "mine");
  EXPECT_EQ(directory.read("transitions.csv.kept"), "mine");
  EXPECT_EQ(directory.read("events.csv"), "new");
  EXPECT_FALSE(directory.has("events.csv.kept"));
  EXPECT_TRUE(fs::is_symlink(directory.path / "summary.json.kept"));
  EXPECT_EQ(directory.read("summary.json"), "new");
}

TEST_F(AnOutputDirectory, TakesTheFiguresOfItsOwnRunOnly) {
  make(directory.path, "run", "1", {{"events.csv", "of run 1"}});
  make(directory.path, "figures", "1", {{"response.svg", "of run 1"}});
  EXPECT_EQ(listed_text(directory.path, "events.csv"), "of run 1");
  EXPECT_EQ(listed_text(directory.path, "response.svg"), "of run 1");
  expect_in(refusal_of(directory.path, "figures", "2"), "holds the results of another run");
  OutputDirectory run(directory.path, "run", "2");
  commit(run, "events.csv", "of run 2");
  EXPECT_FALSE(directory.has("response.svg"));
}

TEST_F(AnOutputDirectory, DoesNotMixTheFiguresOfTwoRunsWithoutIdentity) {
  make(directory.path, "figures", "", {{"bending.svg", "of one run"}});
  OutputDirectory figures(directory.path, "figures", "");
  commit(figures, "response.svg", "of another run");
  EXPECT_FALSE(directory.has("bending.svg"));
}

TEST_F(AnOutputDirectory, HoldsFilesOfOneKind) {
  make(directory.path, "compare", "1", {{"comparison.csv", "1"}});
  expect_in(refusal_of(directory.path, "run"), "holds the results of `subimpact compare`");
  EXPECT_EQ(refusal_of(directory.path, "compare"), "(accepted)");
}

TEST_F(AnOutputDirectory, WithAManifestOfAnotherProgramIsRefused) {
  directory.write("manifest.json", "{\"name\": \"of a web page\"}");
  expect_in(refusal_of(directory.path, "run"), "is not a manifest of this program");
  EXPECT_EQ(names_in(directory.path), (Names{"manifest.json"}));
}

// A manifest from elsewhere may name files outside its directory.
TEST_F(AnOutputDirectory, IsNotLedOutsideByItsManifest) {
  directory.write("outside", "x");
  fs::create_directory(directory.path / "inside");
  std::ofstream(directory.path / "inside" / "manifest.json")
      << R"({"subimpact_manifest": 1, "kind": "run", "identity": "1", "commit": "1", "files": {},
             "replaced": {"../outside": {"bytes": 1, "sha256":
             "2d711642b726b04401627ca9fbac32f5c8530fb1903cc4db02258717921a4881"}}})";
  expect_in(refusal_of(directory.path / "inside", "run"), "is not the name of a file of results");
  EXPECT_TRUE(directory.has("outside"));
}

// The states that a killed writer leaves: before the manifest is replaced, after it, and with some
// of the files moved.
class AKilledWriter : public testing::Test {
 protected:
  AKilledWriter() {
    {
      OutputDirectory files(directory_.path, "run", "1");
      write_file(files.staging() / "a.csv", "old a");
      commit(files, "b.csv", "old b");
    }
    fs::copy(directory_.path, killed_.path, fs::copy_options::recursive);
    OutputDirectory files(directory_.path, "run", "2");
    write_file(files.staging() / "a.csv", "new a");
    write_file(files.staging() / "b.csv", "new b");
    staging_ = files.staging().filename();
    fs::copy(files.staging(), killed_.path / staging_);
    files.commit();
  }
  void replace_manifest() {
    fs::copy_file(directory_.path / "manifest.json", killed_.path / "manifest.json",
                  fs::copy_options::overwrite_existing);
  }
  std::string read() const {
    return listed_text(killed_.path, "a.csv") + ", " + listed_text(killed_.path, "b.csv");
  }

  TemporaryDirectory directory_, killed_;
  fs::path staging_;
};

TEST_F(AKilledWriter, LeavesTheOlderFilesBeforeItsManifest) {
  EXPECT_EQ(read(), "old a, old b");
  const OutputDirectory next(killed_.path, "run");
  EXPECT_EQ(read(), "old a, old b");
  EXPECT_FALSE(fs::exists(killed_.path / staging_));
}

TEST_F(AKilledWriter, LeavesTheNewerFilesFromItsManifestOn) {
  replace_manifest();
  EXPECT_EQ(read(), "new a, new b");
  fs::rename(killed_.path / staging_ / "a.csv", killed_.path / "a.csv");
  EXPECT_EQ(read(), "new a, new b");
  const OutputDirectory next(killed_.path, "run");
  EXPECT_EQ(read(), "new a, new b");
  EXPECT_EQ(read_file(killed_.path / "b.csv"), "new b");
  EXPECT_FALSE(fs::exists(killed_.path / staging_));
}

TEST_F(AFullDisk, IsNamedByTheFileThatCannotBeWritten) {
  std::string message;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 1000);
    message = message_of<OutputError>(
        [&] { write_file(directory.path / "events.csv", std::string(5000, 'x')); });
  }
  expect_in(message, "events.csv: cannot be written (File too large); free the disk");
}

// Rows of 485 TB.
TEST(ADiskTooSmall, IsFoundBeforeTheRunAndTheOlderFilesStay) {
  const TemporaryDirectory directory;
  make(directory.path, "run", "1", {{"events.csv", "old"}});
  const Names before = names_in(directory.path);
  Case input;
  input.end_time = 1.0;
  input.output.interval = 2e-7;
  input.output.sections.assign(1'000'000, 0.5);
  EXPECT_GT(expected_bytes(input), 4.8e14);
  expect_in(message_of<OutputError>([&] { const ResultWriter files(directory.path, input); }),
            directory.path.string() + ": the rows of this run take some 4.9e+05 GB, and",
            "use a longer output.interval, or choose another directory with --out");
  EXPECT_EQ(names_in(directory.path), before);
}

TEST_F(AnOutputDirectory, KeepsHiddenFilesThatTheProgramDidNotMake) {
  fs::create_directory(directory.path / ".subimpact-backup");
  write_file(directory.path / ".subimpact-backup" / "data", "mine");
  write_file(directory.path / ".subimpact-notes", "mine");
  OutputDirectory files(directory.path, "run");
  commit(files, "events.csv", "1");
  EXPECT_EQ(directory.read(".subimpact-backup/data"), "mine");
  EXPECT_EQ(directory.read(".subimpact-notes"), "mine");
}

TEST(APipeInPlaceOfAFile, IsRefusedInsteadOfWaitedFor) {
  const TemporaryDirectory directory;
  make(directory.path, "run", "1", {{"events.csv", "1"}});
  const fs::path file = directory.path / "events.csv";
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  expect_in(message_of<ResultsError>([&] { listed_text(directory.path, "events.csv"); }),
            "it is no regular file");
}

TEST(ADirectoryRemovedDuringARun, IsRefusedAtItsEnd) {
  const TemporaryDirectory directory;
  Case input;
  input.end_time = 1e-3;
  ResultWriter files(directory.path / "here", input);
  fs::remove_all(directory.path / "here");
  EXPECT_THROW(files.finish(input, Result{}), OutputError);
  EXPECT_TRUE(fs::is_empty(directory.path));
}

}  // namespace
}  // namespace subimpact
