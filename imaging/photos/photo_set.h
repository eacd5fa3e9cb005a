// Which photographs belong to which run, from the names of the files in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "imaging/photos/experiment.h"

namespace talus::imaging {

struct PhotoFile {
  std::string view;  // what {view} stands for in its name
  std::filesystem::path path;
};

struct PhotoFiles {
  std::string run;  // what {run} stands for; "1" where the pattern has none
  std::vector<PhotoFile> views;
};

struct PhotoSet {
  std::vector<PhotoFiles> runs;      // in the order of their names, numbers by value
  std::vector<std::string> missing;  // "run 03 has no view 07", one a view that other runs have or
                                     // that a numbering without gaps would have; of views without
                                     // names "run 03 has 4 views, others have 6"
  std::string pattern;               // that the names were read by; empty for runs one by one
};

// The photographs that the options name: a folder with a pattern, or runs one by one.
PhotoSet NamePhotos(const ExperimentOptions& options);

// What the photographs are called where nothing else is said.
inline constexpr const char* kUsualPattern = "run{run}_view{view}.*";

// The images in a folder, in order of name.
std::vector<std::filesystem::path> ImagesIn(const std::filesystem::path& folder);

// The pattern that fits the images of a folder, or the files, which is taken where none is named:
// the usual one, {run}/* for a folder a heap (*/{run}/* where these stand in further ones), or one
// that makes runs of equally many views;
// "*" where none does: they are views of one heap, as a phone names them.
std::string RecognisePattern(const std::filesystem::path& folder);
std::string RecognisePattern(const std::vector<std::filesystem::path>& files);

// How photographs were read: "3 heaps (01, 02, 03), 48 photographs, read by the pattern "{run}/*"";
// where names tell no heaps apart it says that all are taken for one, and what to do if they are
// not.
std::string ReadingText(const PhotoSet& set);

// "run 03 has no view 07, and 2 more are missing"; empty where nothing is.
std::string MissingText(const PhotoSet& set);

// The images in the folder, and in those within it, that are not in the set.
std::vector<std::filesystem::path> UnreadImages(const std::filesystem::path& folder,
                                                const PhotoSet& set);

// The same in words, "2 images not read: a.jpg, b.jpg"; empty where all were.
std::string UnreadText(const std::filesystem::path& folder, const PhotoSet& set);

// A pattern (photo_pattern.h), or "" for the one that fits. One without {view} numbers the files of
// a run in order of name. Throws ConfigError when the folder cannot be read or holds no match, and
// says what is there.
PhotoSet FindPhotos(const std::filesystem::path& folder, const std::string& pattern);

// The same for files one by one; those that do not match are left out, and there may be no run.
PhotoSet SortPhotos(const std::vector<std::filesystem::path>& files, const std::string& pattern);

}  // namespace talus::imaging
