// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Files that end early, were altered, hold unknown sections, or are still growing.

#include <pcl/surface/nurbs/nurbs_file.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::readBytes;
using pcl::nurbs::test::TemporaryFile;
using Bytes = std::vector<std::uint8_t>;

void
writeBytes(const std::string& path, const Bytes& bytes)
{
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

/** A small file with two sections of patches. */
Bytes
sampleFile(const SurfaceModel& model)
{
  const TemporaryFile file("_sample.nurbs");
  NurbsFileOptions options;
  options.lossless = true;
  NurbsFileWriter writer(file.path(), model.frame_id, options);
  for (const SurfacePatch& patch : model.patches)
    writer.appendPatches({patch});
  writer.appendMetadata(model.metadata);
  writer.finish();
  return readBytes(file.path());
}

TEST(NurbsFileDamage, everyTruncationIsRefusedAndRecovered)
{
  const SurfaceModel model = test::randomModel(3, 2);
  const Bytes bytes = sampleFile(model);
  const TemporaryFile file("_cut.nurbs");
  std::size_t most = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    writeBytes(file.path(), Bytes(bytes.begin(), bytes.begin() + size));
    EXPECT_THROW(readNurbsFile(file.path()), NurbsFileError);
    std::string damage;
    if (size < 16) {
      EXPECT_THROW(recoverNurbsFile(file.path(), damage), NurbsFileError);
      continue;
    }
    const SurfaceModel read = recoverNurbsFile(file.path(), damage);
    EXPECT_NE(damage, "");
    EXPECT_NE(damage.find(file.path()), std::string::npos);
    ASSERT_LE(most, read.patches.size()); // never fewer from more bytes
    most = read.patches.size();
    for (std::size_t i = 0; i < most; ++i)
      test::expectIdentical(read.patches[i], model.patches[i]);
  }
  EXPECT_EQ(most, 2U);
}

TEST(NurbsFileDamage, everyFlippedBitIsNoticed)
{
  const Bytes bytes = sampleFile(test::randomModel(4, 2));
  const TemporaryFile file("_flip.nurbs");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i] = static_cast<std::uint8_t>(flipped[i] ^ (1U << (i % 8)));
    writeBytes(file.path(), flipped);
    EXPECT_THROW(readNurbsFile(file.path()), NurbsFileError) << "byte " << i;
  }
}

/** Without the check sum in between: the decoder itself must stand any bytes. */
TEST(NurbsFileDamage, alteredPatchBytesNeverCrashTheDecoder)
{
  RandomNurbs random(8);
  for (bool lossless : {false, true}) {
    NurbsFileOptions options;
    options.lossless = lossless;
    const Bytes bytes = encodePatches(test::randomModel(6, 6).patches, options);
    int refused = 0;
    for (int n = 0; n < 3000; ++n) {
      Bytes altered = bytes;
      for (int k = random.integer(1, 4); k > 0; --k)
        altered[random.integer(0, static_cast<int>(bytes.size()) - 1)] =
            static_cast<std::uint8_t>(random.integer(0, 255));
      std::uint64_t numbers = 100000;
      try {
        static_cast<void>(decodePatches(altered, numbers));
        EXPECT_LE(numbers, 100000U);
      } catch (const std::exception&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 100);
  }
}

TEST(NurbsFileDamage, limitsAreKept)
{
  const TemporaryFile file("_limits.nurbs");
  const SurfaceModel model = test::randomModel(9, 4);
  writeNurbsFile(file.path(), model);
  NurbsFileLimits limits;
  limits.numbers = 200;
  EXPECT_THROW(readNurbsFile(file.path(), limits), NurbsFileError);
  limits = {};
  limits.section_bytes = 100;
  EXPECT_THROW(readNurbsFile(file.path(), limits), NurbsFileError);
  try {
    readNurbsFile(file.path(), limits);
  } catch (const NurbsFileError& error) {
    EXPECT_EQ(error.section(), "PTCH");
    EXPECT_NE(std::string(error.what()).find(file.path()), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("limit"), std::string::npos);
  }
}

TEST(NurbsFileDamage, otherFilesAreRefused)
{
  const TemporaryFile file("_other.nurbs");
  EXPECT_THROW(readNurbsFile(file.path()), NurbsFileError); // is not there
  writeBytes(file.path(), Bytes(1000, 'x'));
  EXPECT_THROW(readNurbsFile(file.path()), NurbsFileError);
  EXPECT_THROW(readNurbsFile("/"), NurbsFileError);
}

TEST(NurbsFileSections, unknownOnesAreSkipped)
{
  const SurfaceModel model = test::randomModel(5, 3);
  const TemporaryFile file("_unknown.nurbs");
  NurbsFileOptions options;
  options.lossless = true;
  NurbsFileWriter writer(file.path(), model.frame_id, options);
  writer.appendSection({'X', 'T', 'R', 'A'}, Bytes(5000, 7));
  writer.appendPatches(model.patches);
  writer.appendSection({'N', 'O', 'N', 'E'}, {});
  writer.appendMetadata(model.metadata);
  writer.finish();
  test::expectIdentical(readNurbsFile(file.path()), model);
  EXPECT_LT(std::filesystem::file_size(file.path()), 16000U);

  NurbsFileReader reader(file.path());
  NurbsSection section;
  std::string types;
  while (reader.next(section)) {
    types.append(section.type.begin(), section.type.end());
    if (section.type == NurbsSectionType{'X', 'T', 'R', 'A'}) {
      EXPECT_EQ(section.bytes, Bytes(5000, 7));
    }
  }
  EXPECT_EQ(types, "HEADXTRAPTCHNONEMETAINDX");
}

TEST(NurbsFileSections, indexLeadsToThePatches)
{
  const SurfaceModel model = test::randomModel(6, 5);
  const TemporaryFile file("_index.nurbs");
  NurbsFileOptions options;
  options.lossless = true;
  NurbsFileWriter writer(file.path(), "map", options);
  for (const SurfacePatch& patch : model.patches)
    writer.appendPatches({patch, patch});
  writer.finish();
  NurbsFileReader reader(file.path());
  const std::vector<NurbsIndexEntry> index = reader.index();
  ASSERT_EQ(index.size(), 5U);
  reader.seek(index[3].offset);
  NurbsSection section;
  ASSERT_TRUE(reader.next(section));
  SurfaceModel part;
  reader.decode(section, part);
  ASSERT_EQ(part.patches.size(), index[3].patches);
  test::expectIdentical(part.patches[1], model.patches[3]);
  const NurbsSurface& surface = model.patches[3].geometry.surface();
  for (int i = 0; i < surface.numControlPointsU(); ++i)
    for (int j = 0; j < surface.numControlPointsV(); ++j) {
      const Eigen::Array3f point = surface.controlPoint(i, j).cast<float>();
      EXPECT_TRUE((index[3].low.array() <= point).all());
      EXPECT_TRUE((index[3].high.array() >= point).all());
    }
}

TEST(NurbsFileSections, aDriveThatDiesLeavesWhatItFinished)
{
  const SurfaceModel model = test::randomModel(7, 4);
  const TemporaryFile file("_drive.nurbs");
  NurbsFileOptions options;
  options.lossless = true;
  {
    NurbsFileWriter writer(file.path(), model.frame_id, options);
    for (std::size_t i = 0; i < 3; ++i) {
      writer.appendPatches({model.patches[i]});
      std::string damage; // readable while the writer is at work
      EXPECT_EQ(recoverNurbsFile(file.path() + ".part", damage).patches.size(), i + 1);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(file.path()));
  std::string damage;
  const SurfaceModel read = recoverNurbsFile(file.path() + ".part", damage);
  EXPECT_NE(damage.find("not finished"), std::string::npos);
  EXPECT_EQ(read.frame_id, model.frame_id);
  ASSERT_EQ(read.patches.size(), 3U);
  test::expectIdentical(read.patches[2], model.patches[2]);
}

} // namespace
