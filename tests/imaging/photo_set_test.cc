#include "imaging/photos/photo_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace talus::imaging {
namespace photo_set_test {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Names(const PhotoSet& set) {
  std::vector<std::string> names;
  for (const PhotoFiles& run : set.runs) {
    for (const PhotoFile& view : run.views) {
      names.push_back(run.run + "/" + view.view + "=" + view.path.string());
    }
  }
  return names;
}

// As a regular expression it took time that doubled with each star.
TEST(PhotoSet, ThirtyStarsAreNotWaitedFor) {
  std::string pattern;
  for (int i = 0; i < 30; ++i) pattern += "*a";
  EXPECT_THAT(Names(SortPhotos({std::string(200, 'a') + "b"}, pattern)), IsEmpty());
  EXPECT_THAT(Names(SortPhotos({std::string(200, 'a')}, pattern)).size(), 1u);
  EXPECT_THROW(SortPhotos({"a.jpg"}, std::string(300, '*')), base::ConfigError);
}

// It ended the program. Whoever may read all, as root, sees what is in it.
TEST(PhotoSet, AFolderThatMayNotBeReadIsPassedOver) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "sealed_photos";
  const fs::path sealed = folder / "a";
  fs::create_directories(sealed);
  std::ofstream(folder / "b.png") << "x";
  fs::permissions(sealed, fs::perms::none);
  const std::vector<fs::path> unread = UnreadImages(folder, {});
  fs::permissions(sealed, fs::perms::owner_all);
  EXPECT_THAT(unread, ElementsAre(folder / "b.png"));
}

TEST(PhotoSet, RunsAndViewsAreSortedByNumber) {
  const PhotoSet set = SortPhotos(
      {"run10_view1.jpg", "run2_view0.jpg", "run2_view1.jpg", "run10_view0.png", "notes.txt"},
      "run{run}_view{view}.*");
  EXPECT_THAT(Names(set), ElementsAre("2/0=run2_view0.jpg", "2/1=run2_view1.jpg",
                                      "10/0=run10_view0.png", "10/1=run10_view1.jpg"));
  EXPECT_THAT(set.missing, IsEmpty());
}

TEST(PhotoSet, ViewOfAnotherRunIsMissing) {
  const PhotoSet set = SortPhotos({"a-1.png", "a-2.png", "b-1.png"}, "{run}-{view}.png");
  ASSERT_EQ(set.missing.size(), 1u);
  EXPECT_THAT(set.missing[0], testing::HasSubstr("run b has no view 2"));
}

TEST(PhotoSet, GapInANumberingIsMissingButNotBetweenAngles) {
  EXPECT_EQ(SortPhotos({"v00.png", "v01.png", "v03.png"}, "v{view}.png").missing.size(), 1u);
  EXPECT_THAT(SortPhotos({"v000.png", "v045.png", "v090.png"}, "v{view}.png").missing, IsEmpty());
}

TEST(PhotoSet, PatternWithoutViewNumbersTheFiles) {
  EXPECT_THAT(Names(SortPhotos({"heap (1).jpg", "heap (2).jpg"}, "heap*.jpg")),
              ElementsAre("1/1=heap (1).jpg", "1/2=heap (2).jpg"));
}

TEST(PhotoSet, TwoFilesForOneViewAreAnError) {
  EXPECT_THROW(SortPhotos({"run1_view1.jpg", "run1_view1.png"}, "run{run}_view{view}.*"),
               base::ConfigError);
}

}  // namespace photo_set_test
}  // namespace talus::imaging
