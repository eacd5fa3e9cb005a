// Which photographs belong to which run, from the names of the files in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
                                     // that a numbering without gaps would have
};

// {run} and {view} stand for one or more characters each (a pattern without {view} numbers the
// files in order of name), * for any. Throws ConfigError when the folder cannot be read or holds no
// match.
PhotoSet FindPhotos(const std::filesystem::path& folder, const std::string& pattern);

// The same for files one by one; those that do not match are left out, and there may be no run.
PhotoSet SortPhotos(const std::vector<std::filesystem::path>& files, const std::string& pattern);

}  // namespace talus::imaging
