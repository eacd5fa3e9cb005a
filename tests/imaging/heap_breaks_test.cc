// Photographs of several heaps in one run, told by what lies between them.
#include "imaging/photos/heap_breaks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "imaging/formats/images/exif.h"

namespace talus::imaging {
namespace heap_breaks_test {

using testing::HasSubstr;

// Views of heaps one after the other, as a phone counts them, all alike unless `set` says more.
MeasuredRun Heaps(int num_heaps, int num_views,
                  const std::function<void(int heap, int view, MeasuredView&)>& set) {
  MeasuredRun run{.name = "1", .profile = {}, .views = {}};
  for (int heap = 0; heap < num_heaps; ++heap) {
    for (int view = 0; view < num_views; ++view) {
      MeasuredView& added = run.views.emplace_back();
      added.photo = "IMG_" + std::to_string(run.views.size()) + ".jpg";
      added.nebp = 10000;
      set(heap, view, added);
    }
  }
  return run;
}

std::string TextOf(const MeasuredRun& run) {
  const auto doubt = DoubtOfOneHeap(run);
  return doubt ? WarningText(*doubt) : "no doubt";
}

TEST(HeapBreaks, OneHeapIsNotDoubted) {
  const auto plain = [](int, int, MeasuredView&) {};
  EXPECT_EQ(TextOf(Heaps(1, 16, plain)), "no doubt");
  EXPECT_EQ(TextOf(Heaps(1, 1, plain)), "no doubt");
  // Outlines and the plate's place as a turning table gives them, one view taken again later.
  const auto turned = [](int, int view, MeasuredView& v) {
    v.step = 200 + 50 * (view % 3);
    v.plate.center_x = 320 + 0.3 * (view % 4);
    v.taken = 10 * view + (view == 15 ? 900 : 0);
  };
  EXPECT_EQ(TextOf(Heaps(1, 16, turned)), "no doubt");
}

TEST(HeapBreaks, APauseBetweenExposuresIsAnotherHeap) {
  const auto timed = [](int heap, int view, MeasuredView& v) { v.taken = 900 * heap + 12 * view; };
  const std::string text = TextOf(Heaps(3, 4, timed));
  EXPECT_THAT(text, HasSubstr("IMG_5.jpg: begins another heap, it seems: taken 14 min after "
                              "IMG_4.jpg; the 12 photographs of run 1 look like 3 heaps"));
  EXPECT_THAT(text, HasSubstr("give each heap a folder of its own"));
}

TEST(HeapBreaks, TheTimesInNamesCountWhereExifHasNone) {
  const auto named = [](int heap, int view, MeasuredView& v) {
    v.photo = "PXL_20260131_1" + std::to_string(heap) + "0" + std::to_string(view) + "30123.jpg";
  };
  EXPECT_THAT(TextOf(Heaps(2, 3, named)), HasSubstr("look like 2 heaps"));
}

// A photograph that was deleted leaves a gap, too, but hardly between equally many of each heap.
TEST(HeapBreaks, NumbersThatAreMissingBetweenEquallyManyAreAnotherHeap) {
  const auto numbered = [](int heap, int view, MeasuredView& v) {
    v.photo = "DSC_0" + std::to_string(100 + 20 * heap + view) + ".JPG";
  };
  EXPECT_THAT(TextOf(Heaps(3, 8, numbered)), HasSubstr("look like 3 heaps"));
  MeasuredRun deleted = Heaps(1, 9, numbered);
  deleted.views.erase(deleted.views.begin() + 3);
  EXPECT_EQ(TextOf(deleted), "no doubt");
}

TEST(HeapBreaks, APlateThatWasPutBackElsewhereIsAnotherHeap) {
  const auto moved = [](int heap, int view, MeasuredView& v) {
    v.plate.center_x = 320 + 3 * heap + 0.05 * (view % 3);
  };
  EXPECT_THAT(TextOf(Heaps(4, 4, moved)), HasSubstr("the plate stands 3 px off"));
}

// Figures of powder A's photographs, a twelfth of a turn apart: neighbours differ by 1.3 % of the
// powder's area, at most 1.27 times as much, other heaps by twice as much.
TEST(HeapBreaks, AnOutlineThatDiffersMoreThanNeighboursDoIsAnotherHeap) {
  const auto outlined = [](int heap, int view, MeasuredView& v) {
    v.step = view > 0 ? 130 + 10 * (view % 4) : heap > 0 ? 260 : 0;
  };
  EXPECT_THAT(TextOf(Heaps(5, 16, outlined)), HasSubstr("differs by 2.6 % of the powder's area"));
  EXPECT_THAT(TextOf(Heaps(5, 16, outlined)), HasSubstr("look like 5 heaps"));
}

TEST(HeapBreaks, DatesAreReadWithAndWithoutSigns) {
  const auto time = TimeIn("2026:01:31 17:05:09");
  ASSERT_TRUE(time);
  EXPECT_EQ(*time, 1769879109);  // as `date -u -d "2026-01-31 17:05:09" +%s` says
  EXPECT_EQ(TimeIn("IMG_20260131_170509_HDR"), time);
  EXPECT_EQ(TimeIn("Photo 2026-01-31 17.05.09"), time);
  EXPECT_EQ(TimeIn("IMG_20261331_170509"), std::nullopt);
  EXPECT_EQ(TimeIn("run01_view07"), std::nullopt);
  EXPECT_EQ(TimeIn(""), std::nullopt);
}

}  // namespace heap_breaks_test
}  // namespace talus::imaging
