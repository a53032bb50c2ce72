#include "core/print/whole_file.h"

#include "core/base/types.h"
#include "core/print/archive.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace massprops::testing {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// An empty folder that goes again.
class WholeFile : public ::testing::Test {
protected:
  void SetUp() override {
    folder = fs::temp_directory_path() /
             ("massprops_" +
              std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder;
};

TEST_F(WholeFile, TakesThePlaceOfTheOldOne) {
  const fs::path path = folder / "a.3mf";
  put(path, "old");
  writeWhole(path.u8string(), [](const std::string& temporary) { put(temporary, "new"); });
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(WholeFile, LeavesTheOldOneWhereAnythingFails) {
  const fs::path path = folder / "a.3mf";
  put(path, "old");
  EXPECT_THROW(writeWhole(path.u8string(),
                          [](const std::string& temporary) {
                            put(temporary, "half");
                            throw std::runtime_error("disk full");
                          }),
               std::runtime_error);
  EXPECT_EQ(contentOf(path), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(WholeFile, IsTriedWithoutAnyTrace) {
  requireWritable((folder / "new.3mf").u8string());
  EXPECT_EQ(files(), 0);
  put(folder / "old.3mf", "old");
  put(folder / "old.3mf.part0", "a user's own");
  requireWritable((folder / "old.3mf").u8string());
  EXPECT_EQ(contentOf(folder / "old.3mf"), "old");
  EXPECT_EQ(contentOf(folder / "old.3mf.part0"), "a user's own");
  EXPECT_EQ(files(), 2);
}

TEST_F(WholeFile, IsRefusedWhereNoneCanBe) {
  EXPECT_THROW(requireWritable((folder / "missing" / "a.3mf").u8string()), InvalidInput);
  fs::create_directory(folder / "a.3mf");
  EXPECT_THROW(requireWritable((folder / "a.3mf").u8string()), InvalidInput);
  EXPECT_THROW(requireWritable((folder / "a.ply").u8string()), InvalidInput);
  EXPECT_EQ(files(), 1);
}

TEST_F(WholeFile, OfAnArchiveHasTheSameBytesEachTime) {
  const std::vector<ArchiveEntry> entries = {{"a/b.txt", std::string(1000, 'x')}, {"c", ""}};
  writeArchive((folder / "1").string(), entries);
  writeArchive((folder / "2").string(), entries);
  const std::string bytes = contentOf(folder / "1");
  EXPECT_EQ(bytes, contentOf(folder / "2"));
  EXPECT_EQ(bytes.substr(0, 2), "PK");
  EXPECT_LT(bytes.size(), 500U);
  EXPECT_NE(bytes.find("a/b.txt"), std::string::npos);
  EXPECT_THROW(writeArchive((folder / "missing" / "3").string(), entries), std::runtime_error);
}

} // namespace
} // namespace massprops::testing
