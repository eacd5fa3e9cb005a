#include "imaging/photos/photo_set.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/text/counted.h"
#include "base/text/lower.h"
#include "base/text/printable.h"
#include "imaging/photos/photo_pattern.h"

namespace talus::imaging {
namespace {

constexpr const char* kFolders = "{run}/*";        // a folder a heap
constexpr const char* kDeepFolders = "*/{run}/*";  // … in folders by day, or by powder

// Numbers by value, before words.
struct ByNumber {
  static std::optional<unsigned long> Number(const std::string& text) {
    const bool digits =
        !text.empty() && text.size() <= 9 &&
        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits ? std::optional(std::stoul(text)) : std::nullopt;
  }
  bool operator()(const std::string& a, const std::string& b) const {
    const auto x = Number(a);
    const auto y = Number(b);
    if (x && y && *x != *y) return *x < *y;
    if (x.has_value() != y.has_value()) return x.has_value();
    return a < b;
  }
};

using Views = std::map<std::string, std::filesystem::path, ByNumber>;

bool EndsLike(const std::filesystem::path& file, std::span<const std::string_view> endings) {
  return std::ranges::find(endings, base::Lower(file.extension().string())) != endings.end();
}

bool IsImage(const std::filesystem::path& file) {
  static constexpr std::string_view kEndings[] = {".png", ".jpg",  ".jpeg", ".jfif", ".jpe",
                                                  ".tif", ".tiff", ".bmp",  ".pgm"};
  return EndsLike(file, kEndings);
}

// What telephones and cameras write that we cannot read.
bool IsForeignImage(const std::filesystem::path& file) {
  static constexpr std::string_view kEndings[] = {".heic", ".heif", ".avif", ".webp", ".gif",
                                                  ".dng",  ".cr2",  ".cr3",  ".nef",  ".arw",
                                                  ".raf",  ".orf",  ".rw2"};
  return EndsLike(file, kEndings);
}

constexpr const char* kForeign =
    "; HEIC, WebP, GIF and raw files are not read: convert them to JPEG or PNG (a telephone takes "
    "JPEG "
    "where its camera is set to the most compatible format)";

// "._IMG_1.jpg" and the like are a system's notes on a file.
bool IsHidden(const std::filesystem::path& file) {
  return file.filename().string().starts_with('.');
}

// Files so many folders below, in order of name.
void AddFiles(const std::filesystem::path& folder, int num_folders,
              std::vector<std::filesystem::path>& files) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) {
    throw base::ConfigError(folder.string() + ": cannot be read as a folder of photographs (" +
                            error.message() + ")");
  }
  std::vector<std::filesystem::path> here;
  for (const auto& file : entry) {
    // Pipes and dangling links are no photographs; a pipe that was opened would be waited for.
    const bool wanted = num_folders > 0 ? file.is_directory(error) : file.is_regular_file(error);
    if (wanted && !IsHidden(file.path())) here.push_back(file.path());
  }
  std::sort(here.begin(), here.end());
  for (const std::filesystem::path& path : here) {
    if (num_folders == 0) {
      files.push_back(path);
    } else {
      AddFiles(path, num_folders - 1, files);
    }
  }
}

// The file's name with so many folders before it.
std::string NameOf(const std::filesystem::path& file, int num_folders) {
  std::filesystem::path name = file.filename();
  std::filesystem::path folder = file.parent_path();
  for (int i = 0; i < num_folders; ++i) {
    name = folder.filename() / name;
    folder = folder.parent_path();
  }
  return name.generic_string();
}

// Every view that some run has, and those that a numbering in steps of one leaves out.
std::set<std::string, ByNumber> ExpectedViews(const std::map<std::string, Views, ByNumber>& runs) {
  std::set<std::string, ByNumber> expected;
  for (const auto& [run, views] : runs) {
    for (const auto& [view, path] : views) expected.insert(view);
  }
  std::set<std::string, ByNumber> gaps;
  bool by_one = false;
  std::optional<unsigned long> before;
  for (const std::string& view : expected) {
    const auto number = ByNumber::Number(view);
    if (!number) return expected;
    by_one |= before && *number == *before + 1;
    for (unsigned long gap = before.value_or(*number) + 1; gap < *number && gap < 10000; ++gap) {
      const std::string digits = std::to_string(gap);
      gaps.insert(std::string(view.size() - std::min(view.size(), digits.size()), '0') + digits);
    }
    before = number;
  }
  if (by_one && gaps.size() < expected.size()) expected.merge(gaps);
  return expected;
}

std::map<std::string, Views, ByNumber> Group(const std::vector<std::filesystem::path>& files,
                                             const PhotoPattern& pattern) {
  std::map<std::string, Views, ByNumber> runs;
  std::map<std::string, int> counted;  // files of a run so far, for a pattern without {view}
  for (const std::filesystem::path& file : files) {
    const std::string name = NameOf(file, pattern.num_folders());
    const auto match = pattern.Fit(name);
    if (!match) continue;
    const std::string run = pattern.has_run() ? match->run : "1";
    const std::string view = pattern.has_view() ? match->view : std::to_string(++counted[run]);
    const auto [entry, added] = runs[run].emplace(view, file);
    if (added) continue;
    throw base::ConfigError(file.string() + ": is view " + view + " of run " + run +
                            ", and so is " + entry->second.filename().string() +
                            "; make the pattern \"" + pattern.text() + "\" tell them apart");
  }
  return runs;
}

std::string FewerViewsText(const std::string& run, std::size_t has, std::size_t others) {
  return "run " + run + " has " + base::Counted(static_cast<long long>(has), "view") +
         ", others have " + std::to_string(others);
}

PhotoSet SetOf(const std::map<std::string, Views, ByNumber>& runs, const std::string& pattern) {
  PhotoSet set{.runs = {}, .missing = {}, .pattern = pattern};
  const std::set<std::string, ByNumber> expected = ExpectedViews(runs);
  const bool has_names = PhotoPattern(pattern).has_view();
  for (const auto& [run, views] : runs) {
    if (!has_names && views.size() < expected.size()) {
      set.missing.push_back(FewerViewsText(run, views.size(), expected.size()));
    }
    PhotoFiles& files = set.runs.emplace_back(PhotoFiles{.run = run, .views = {}});
    for (const std::string& view : expected) {
      const auto found = views.find(view);
      if (found != views.end()) {
        files.views.push_back({.view = view, .path = found->second});
      } else if (has_names) {
        set.missing.push_back("run " + run + " has no view " + view + " (pattern \"" + pattern +
                              "\")");
      }
    }
  }
  return set;
}

// Views of runs that are given one by one have no names.
PhotoSet GivenPhotos(const std::vector<PhotoRun>& runs, const std::string& pattern) {
  PhotoSet set{.runs = {}, .missing = {}, .pattern = pattern};
  std::size_t most = 0;
  for (const PhotoRun& run : runs) most = std::max(most, run.photos.size());
  for (const PhotoRun& run : runs) {
    PhotoFiles& files = set.runs.emplace_back(PhotoFiles{.run = run.name, .views = {}});
    for (const auto& path : run.photos) files.views.push_back({.view = {}, .path = path});
    if (run.photos.size() == most) continue;
    set.missing.push_back(FewerViewsText(run.name, run.photos.size(), most));
  }
  return set;
}

// Whether names fall into runs of the same views by the pattern, and none is left over. Some views
// may be missing, which is said when the set is made.
bool Splits(const std::vector<std::filesystem::path>& files, const std::string& pattern) {
  try {
    const std::map<std::string, Views, ByNumber> runs = Group(files, PhotoPattern(pattern));
    std::size_t count = 0;
    for (const auto& [run, views] : runs) count += views.size();
    if (count != files.size() || runs.size() < 2) return false;
    const bool are_equal = count == runs.size() * runs.begin()->second.size();
    return are_equal || 4 * count > 3 * runs.size() * ExpectedViews(runs).size();
  } catch (const base::ConfigError&) {
    return false;  // two photographs would be one view of one run
  }
}

// The images so many folders below.
std::vector<std::filesystem::path> ImagesBelow(const std::filesystem::path& folder,
                                               int num_folders) {
  std::vector<std::filesystem::path> files;
  AddFiles(folder, num_folders, files);
  std::erase_if(files, [](const std::filesystem::path& file) { return !IsImage(file); });
  return files;
}

// Whether every folder of images two below has a name of its own, as a run needs it.
bool AreNamedApart(const std::vector<std::filesystem::path>& files) {
  std::map<std::string, std::filesystem::path> folders;
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path folder = file.parent_path();
    if (folders.try_emplace(folder.filename().string(), folder).first->second != folder) {
      return false;
    }
  }
  return !files.empty();
}

// Whether the pattern fits every name.
bool FitsAll(const std::vector<std::filesystem::path>& files, const std::string& pattern) {
  const PhotoPattern parsed(pattern);
  return std::ranges::all_of(files, [&](const std::filesystem::path& file) {
    return parsed.Fit(NameOf(file, parsed.num_folders())).has_value();
  });
}

// What is in a folder, for a message: the first names.
std::string Listed(const std::filesystem::path& folder) {
  constexpr std::size_t kMostNames = 3;
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    names.push_back(entry.path().filename().string() + (entry.is_directory(error) ? "/" : ""));
  }
  if (names.empty()) return "it is empty";
  std::ranges::sort(names);
  std::string text = "there are ";
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
    text += (i == 0 ? "" : ", ") + base::Printable(names[i]);
  }
  return text + (names.size() > kMostNames ? ", … (" + std::to_string(names.size()) + ")" : "");
}

// Where no pattern could help.
void RequireAnImage(const std::filesystem::path& folder) {
  for (const int depth : {0, 1, 2}) {
    if (!ImagesBelow(folder, depth).empty()) return;
  }
  throw base::ConfigError(folder.string() + ": holds no image that is read: " + Listed(folder) +
                          "; give photographs as PNG, JPEG, TIFF, BMP or PGM, or convert them to "
                          "one of these (a telephone takes JPEG where its camera is set to the "
                          "most compatible format)");
}

// The set with its folder in all that it says; throws where it is empty.
PhotoSet OfFolder(PhotoSet set, const std::filesystem::path& folder, const std::string& pattern) {
  if (set.runs.empty()) {
    RequireAnImage(folder);
    const std::string other = RecognisePattern(folder);
    throw base::ConfigError(
        folder.string() + ": no file matches the pattern \"" + pattern +
        "\" of the photographs' names; " + Listed(folder) +
        (other == pattern ? "" : "; a pattern that may fit is \"" + other + "\"") +
        (std::ranges::any_of(UnreadImages(folder, set), IsForeignImage) ? kForeign : ""));
  }
  for (std::string& missing : set.missing) missing = folder.string() + ": " + missing;
  return set;
}

}  // namespace

PhotoSet SortPhotos(const std::vector<std::filesystem::path>& files, const std::string& named) {
  const std::string pattern = named.empty() ? RecognisePattern(files) : named;
  return SetOf(Group(files, PhotoPattern(pattern)), pattern);
}

std::vector<std::filesystem::path> ImagesIn(const std::filesystem::path& folder) {
  return ImagesBelow(folder, 0);
}

std::string RecognisePattern(const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> files = ImagesIn(folder);
  if (!files.empty()) return RecognisePattern(files);
  if (!ImagesBelow(folder, 1).empty()) return kFolders;
  return AreNamedApart(ImagesBelow(folder, 2)) ? kDeepFolders : RecognisePattern(files);
}

std::string RecognisePattern(const std::vector<std::filesystem::path>& files) {
  const auto elsewhere = [&](const auto& file) {
    return file.parent_path() != files.front().parent_path();
  };
  if (std::ranges::any_of(files, elsewhere)) return kFolders;
  if (!files.empty() && FitsAll(files, kUsualPattern)) return kUsualPattern;
  for (const char* pattern :
       {"{run}_{view}.*", "{run}-{view}.*", "{run} ({view}).*", "{run} {view}.*"}) {
    if (Splits(files, pattern)) return pattern;
  }
  // Some of them have the usual names: the others are said to be left unread.
  return SortPhotos(files, kUsualPattern).runs.empty() ? "*" : kUsualPattern;
}

std::string MissingText(const PhotoSet& set) {
  if (set.missing.empty()) return "";
  const std::string first = base::Printable(set.missing.front());
  const std::size_t more = set.missing.size() - 1;
  if (more == 0) return first;
  if (more == 1) return first + ", and another one is missing";
  return first + ", and " + std::to_string(more) + " more are missing";
}

std::string ReadingText(const PhotoSet& set) {
  constexpr std::size_t kMostNames = 12;
  std::size_t views = 0;
  std::string names;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    views += set.runs[i].views.size();
    if (i < kMostNames) names += (i == 0 ? "" : ", ") + base::Printable(set.runs[i].run);
  }
  if (set.runs.size() > kMostNames) names += ", …";
  std::string text = base::Counted(static_cast<long long>(set.runs.size()), "heap") + " (" + names +
                     "), " + base::Counted(static_cast<long long>(views), "photograph");
  if (set.pattern.empty()) return text;
  text += ", read by the pattern \"" + set.pattern + "\"";
  if (views == 1 || PhotoPattern(set.pattern).has_run()) return text;
  return text +
         ": all are taken for views of one heap, as their names tell no heaps apart; several "
         "heaps: a folder each, or, where each has one photograph, the pattern \"{run}.*\"";
}

std::vector<std::filesystem::path> UnreadImages(const std::filesystem::path& folder,
                                                const PhotoSet& set) {
  std::set<std::filesystem::path> read;
  for (const PhotoFiles& run : set.runs) {
    for (const PhotoFile& view : run.views) read.insert(view.path.lexically_normal());
  }
  std::vector<std::filesystem::path> unread;
  std::error_code none;
  constexpr auto kReadable = std::filesystem::directory_options::skip_permission_denied;
  std::filesystem::recursive_directory_iterator at(folder, kReadable, none);
  for (; at != std::filesystem::recursive_directory_iterator(); at.increment(none)) {
    const std::filesystem::directory_entry& entry = *at;
    const std::filesystem::path path = entry.path().lexically_normal();
    const bool is_hidden =
        std::ranges::any_of(path.lexically_relative(folder.lexically_normal()), IsHidden);
    const bool is_image = (IsImage(path) || IsForeignImage(path)) && !is_hidden;
    if (entry.is_regular_file(none) && is_image && !read.contains(path)) {
      unread.push_back(path);
    }
  }
  std::ranges::sort(unread);
  return unread;
}

std::string UnreadText(const std::filesystem::path& folder, const PhotoSet& set) {
  constexpr std::size_t kMostNames = 3;
  const std::vector<std::filesystem::path> unread = UnreadImages(folder, set);
  if (unread.empty()) return "";
  std::string text = base::Counted(static_cast<long long>(unread.size()), "image") + " not read: ";
  for (std::size_t i = 0; i < std::min(unread.size(), kMostNames); ++i) {
    text += (i == 0 ? "" : ", ") +
            base::Printable(unread[i].lexically_relative(folder.lexically_normal()).string());
  }
  return text + (unread.size() > kMostNames ? ", …" : "") +
         (std::ranges::any_of(unread, IsForeignImage) ? kForeign : "");
}

PhotoSet FindPhotos(const std::filesystem::path& folder, const std::string& named) {
  const std::string pattern = named.empty() ? RecognisePattern(folder) : named;
  const auto num_folders = static_cast<int>(std::ranges::count(pattern, '/'));
  std::vector<std::filesystem::path> files;
  if (pattern.ends_with('*') || pattern.ends_with('}')) {
    files = ImagesBelow(folder, num_folders);
  } else {
    AddFiles(folder, num_folders, files);
  }
  return OfFolder(SortPhotos(files, pattern), folder, pattern);
}

PhotoSet NamePhotos(const ExperimentOptions& options) {
  return options.runs.empty() ? FindPhotos(options.photos, options.pattern)
                              : GivenPhotos(options.runs, options.pattern);
}

}  // namespace talus::imaging
