#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "imaging/photos/photo_set.h"
#include "tests/error_in.h"
#include "tests/imaging/photo_folder.h"

namespace talus::imaging {
namespace photo_pattern_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

void Touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

// "3 runs: 1 of 2 views, …" as far as a test needs it.
std::string Read(const fs::path& folder, const std::string& pattern) {
  std::string text;
  for (const PhotoFiles& run : FindPhotos(folder, pattern).runs) {
    text += (text.empty() ? "" : " ") + run.run + ":" + std::to_string(run.views.size());
  }
  return text;
}

TEST(PhotoPattern, FolderIsAHeap) {
  const fs::path folder = EmptyFolder("folders");
  for (const char* name : {"monday 1/IMG_7.jpg", "monday 1/IMG_8.jpg", "monday 2/IMG_9.JPG",
                           "monday 2/IMG_12.JPG", "monday 2/notes.txt"}) {
    Touch(folder / name);
  }
  EXPECT_EQ(Read(folder, "{run}/*.jpg"), "monday 1:2 monday 2:2");
  EXPECT_EQ(Read(folder, "{run}/{view}.jpg"), "monday 1:2 monday 2:2");
  EXPECT_EQ(Read(folder, "{run}/*"), "monday 1:2 monday 2:2");
  EXPECT_EQ(RecognisePattern(folder), "{run}/*");
}

TEST(PhotoPattern, NoPartReachesIntoAFolder) {
  const fs::path folder = EmptyFolder("reach");
  Touch(folder / "a/b_1.jpg");
  EXPECT_THROW(FindPhotos(folder, "*"), base::ConfigError);
  EXPECT_THROW(FindPhotos(folder, "{run}_{view}.jpg"), base::ConfigError);
  EXPECT_EQ(Read(folder, "{run}/*_{view}.jpg"), "a:1");
}

TEST(PhotoPattern, NamesTellOfRuns) {
  const auto recognise = [](std::vector<fs::path> files) { return RecognisePattern(files); };
  EXPECT_EQ(recognise({"run1_view1.jpg", "run1_view2.jpg"}), kUsualPattern);
  EXPECT_EQ(recognise({"h1_01.jpg", "h1_02.jpg", "h2_01.jpg", "h2_02.jpg"}), "{run}_{view}.*");
  EXPECT_EQ(recognise({"h1-01.jpg", "h1-02.jpg", "h2-01.jpg", "h2-02.jpg"}), "{run}-{view}.*");
  EXPECT_EQ(recognise({"h 1 (1).jpg", "h 1 (2).jpg", "h 2 (1).jpg", "h 2 (2).jpg"}),
            "{run} ({view}).*");
  // A view is missing: still two heaps, and the set says which.
  EXPECT_EQ(recognise({"h1_01.jpg", "h1_02.jpg", "h1_03.jpg", "h1_04.jpg", "h2_01.jpg", "h2_02.jpg",
                       "h2_04.jpg"}),
            "{run}_{view}.*");
  EXPECT_EQ(recognise({"a/1.jpg", "b/1.jpg"}), "{run}/*");
  // A phone's names: views of one heap.
  EXPECT_EQ(recognise({"IMG_20240101_1201.jpg", "IMG_20240101_1202.jpg"}), "*");
}

TEST(PhotoPattern, HeapsInFoldersByDayAreHeapsWhereTheirNamesDiffer) {
  const fs::path folder = EmptyFolder("days");
  for (const char* name : {"monday/heap 1/IMG_7.jpg", "monday/heap 1/IMG_8.jpg",
                           "tuesday/heap 2/IMG_1.jpg", "tuesday/heap 2/IMG_2.jpg"}) {
    Touch(folder / name);
  }
  EXPECT_EQ(RecognisePattern(folder), "*/{run}/*");
  EXPECT_EQ(Read(folder, "*/{run}/*"), "heap 1:2 heap 2:2");
  // Two heaps of one name would be taken for one.
  Touch(folder / "wednesday/heap 2/IMG_1.jpg");
  EXPECT_NE(RecognisePattern(folder), "*/{run}/*");
}

// A pattern that fits a part of the photographs is taken for that part, and the rest is named.
TEST(PhotoPattern, WhatIsNotReadIsNamed) {
  const fs::path folder = EmptyFolder("partly");
  for (const char* name : {"run1_view1.jpg", "run1_view2.jpg", "run2_view1.jpg", "run2_view2.jpg",
                           "again.JPG", "extra/a.png", "notes.txt"}) {
    Touch(folder / name);
  }
  const std::string pattern = RecognisePattern(folder);
  EXPECT_EQ(pattern, kUsualPattern);
  const PhotoSet set = FindPhotos(folder, pattern);
  EXPECT_EQ(ReadingText(set),
            "2 heaps (1, 2), 4 photographs, read by the pattern \"run{run}_view{view}.*\"");
  EXPECT_EQ(UnreadText(folder, set), "2 images not read: again.JPG, extra/a.png");
  EXPECT_EQ(UnreadText(folder / "extra", FindPhotos(folder / "extra", "*")), "");
}

// As a telephone's folder comes: a system's notes beside the photographs, a film, and what is no
// JPEG.
TEST(PhotoPattern, HiddenFilesAreNoPhotographsAndOtherFormatsAreNamed) {
  const fs::path folder = EmptyFolder("telephone");
  for (const char* name :
       {"heap 1/IMG_1.JPG", "heap 1/._IMG_1.JPG", "heap 1/IMG_2.JPG", "heap 2/IMG_3.JPG",
        "heap 2/IMG_4.HEIC", "heap 2/VID_5.mp4", ".thumbnails/IMG_1.JPG"}) {
    Touch(folder / name);
  }
  const PhotoSet set = FindPhotos(folder, RecognisePattern(folder));
  EXPECT_THAT(ReadingText(set), HasSubstr("2 heaps (heap 1, heap 2), 3 photographs"));
  EXPECT_THAT(UnreadText(folder, set),
              HasSubstr("1 image not read: heap 2/IMG_4.HEIC; HEIC, WebP, GIF and raw files"));
  const fs::path only = EmptyFolder("heic");
  Touch(only / "IMG_1.HEIC");
  try {
    FindPhotos(only, RecognisePattern(only));
    FAIL() << "no error";
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds no image that is read: there are IMG_1.HEIC"));
    EXPECT_THAT(error.what(), HasSubstr("convert them"));
  }
}

std::string ErrorOf(const fs::path& folder, const std::string& pattern) {
  return ErrorIn([&] { FindPhotos(folder, pattern); });
}

// No file matched "*", which stands for anything.
TEST(PhotoPattern, AFolderOfOtherKindsOfImagesIsSaidToHoldNoneThatIsRead) {
  const fs::path folder = EmptyFolder("other_kinds");
  for (const char* name : {"1.gif", "2.pdf"}) Touch(folder / name);
  EXPECT_THAT(ErrorOf(folder, ""), HasSubstr("no image that is read: there are 1.gif, 2.pdf; "));
  EXPECT_THAT(ErrorOf(folder, ""), HasSubstr("PNG, JPEG, TIFF, BMP or PGM"));
  EXPECT_THAT(ErrorOf(EmptyFolder("nothing_there"), ""), HasSubstr("it is empty"));
}

// Only that no file matched was said.
TEST(PhotoPattern, AWordInBracesThatIsUnknownOrStandsTwiceIsNamed) {
  const fs::path folder = EmptyFolder("words");
  Touch(folder / "a_1.jpg");
  EXPECT_THAT(ErrorOf(folder, "{foo}.*"),
              HasSubstr("has {foo}, which is unknown; write {run} and {view}"));
  EXPECT_THAT(ErrorOf(folder, "{Run}_{view}.*"), HasSubstr("{Run}, which is unknown"));
  EXPECT_THAT(ErrorOf(folder, "{run}_{run}.*"), HasSubstr("has {run} twice"));
  EXPECT_THAT(ErrorOf(folder, "{run_*"), HasSubstr("no file matches"));
}

// Several heaps in one folder cannot be told from one heap by such names: never silently.
TEST(PhotoPattern, NamesThatTellNoHeapsApartAreSaidToBeTakenForOneHeap) {
  const PhotoSet phone = SortPhotos({"IMG_1.jpg", "IMG_2.jpg", "IMG_3.jpg"}, "");
  EXPECT_EQ(phone.pattern, "*");
  EXPECT_THAT(ReadingText(phone),
              HasSubstr("3 photographs, read by the pattern \"*\": all are taken "
                        "for views of one heap"));
  const PhotoSet one_each = SortPhotos({"IMG_1.jpg", "IMG_2.jpg"}, "{run}.*");
  EXPECT_EQ(ReadingText(one_each),
            "2 heaps (IMG_1, IMG_2), 2 photographs, read by the pattern \"{run}.*\"");
}

TEST(PhotoPattern, ErrorSaysWhatIsThereAndWhatMayFit) {
  const fs::path folder = EmptyFolder("there");
  for (const char* name : {"one/a.jpg", "two/a.jpg"}) Touch(folder / name);
  try {
    FindPhotos(folder, kUsualPattern);
    FAIL() << "no error";
  } catch (const base::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("there are one/, two/"));
    EXPECT_THAT(error.what(), HasSubstr("\"{run}/*\""));
  }
}

}  // namespace photo_pattern_test
}  // namespace talus::imaging
