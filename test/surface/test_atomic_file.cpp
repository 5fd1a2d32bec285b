// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/atomic_file.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace {

namespace fs = std::filesystem;
using pcl::nurbs::AtomicFile;
using pcl::nurbs::writeFileAtomically;

class AtomicFileTest : public testing::Test {
protected:
  void
  SetUp() override
  {
    fs::create_directory(folder);
  }

  void
  TearDown() override
  {
    fs::remove_all(folder);
  }

  static std::string
  content(const fs::path& path)
  {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::ptrdiff_t
  entries() const
  {
    return std::distance(fs::directory_iterator(folder), {});
  }

  fs::path folder = fs::path(testing::TempDir()) /
                    (std::string("atomic_") +
                     testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path target = folder / "out.bin";
};

std::string
errorOf(const std::string& path)
{
  try {
    writeFileAtomically(path, "x");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST_F(AtomicFileTest, appearsOnlyWhenCommitted)
{
  AtomicFile file(target.string());
  file.write("half");
  EXPECT_FALSE(fs::exists(target));
  file.write(std::string_view("\0done", 5));
  file.commit();
  EXPECT_EQ(content(target), std::string("half\0done", 9));
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFileTest, keepsTheOldFileWhenAbandoned)
{
  writeFileAtomically(target.string(), "old");
  {
    AtomicFile file(target.string());
    file.write("new");
  }
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(AtomicFileTest, replacesAndKeepsPermissions)
{
  writeFileAtomically(target.string(), "old");
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
  writeFileAtomically(target.string(), "new");
  EXPECT_EQ(content(target), "new");
  EXPECT_EQ(fs::status(target).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, namesFileAndReason)
{
  const std::string missing = (folder / "no" / "out.bin").string();
  EXPECT_EQ(errorOf(missing),
            "cannot write " + missing + ": No such file or directory");
  EXPECT_EQ(errorOf(folder.string()),
            "cannot write " + folder.string() + ": Is a directory");
  EXPECT_EQ(entries(), 0);
}

TEST_F(AtomicFileTest, reportsAFullDisk)
{
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "/dev/full is not there";
  EXPECT_EQ(errorOf("/dev/full"), "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFileTest, cannotBeUsedAfterCommit)
{
  AtomicFile file(target.string());
  file.commit();
  EXPECT_THROW(file.write("late"), std::runtime_error);
  EXPECT_THROW(file.commit(), std::runtime_error);
  EXPECT_EQ(content(target), "");
}

} // namespace
