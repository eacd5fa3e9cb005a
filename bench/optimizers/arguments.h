// What a bench is told on its command line, as pairs of a key and a value. What no bench knows,
// what has no value and what cannot be read ends it with status 2: a mistyped run must not look
// like one.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace talus::bench {

class Arguments {
 public:
  Arguments(int argc, char** argv) {
    for (int i = 1; i < argc; i += 2) {
      if (i + 1 == argc) Fail(std::string(argv[i]) + " has no value");
      values_[argv[i]] = argv[i + 1];
    }
  }

  // Each leaves its second argument as it is where the key is not given.
  template <class Value>
  void Take(const std::string& key, Value& value) {
    if (const auto found = values_.extract(key)) value = Read<Value>(key, found.mapped());
  }
  // 1,2,3
  template <class Value>
  void Take(const std::string& key, std::vector<Value>& list) {
    const auto found = values_.extract(key);
    if (!found) return;
    list.clear();
    std::istringstream stream(found.mapped());
    for (std::string one; std::getline(stream, one, ',');) list.push_back(Read<Value>(key, one));
  }
  // 1-8, or 3 for 3-3
  void TakeRange(const std::string& key, int& first, int& last) {
    const auto found = values_.extract(key);
    if (!found) return;
    const std::string& text = found.mapped();
    const auto dash = text.find('-');
    first = Read<int>(key, text.substr(0, dash));
    last = dash == std::string::npos ? first : Read<int>(key, text.substr(dash + 1));
  }

  // To be called once all that the bench knows is taken.
  void End() const {
    for (const auto& [key, value] : values_) {
      Fail(key + " is not known here: see the head of the source");
    }
  }

  [[noreturn]] static void Fail(const std::string& why) {
    std::fprintf(stderr, "%s\n", why.c_str());
    std::exit(2);
  }

 private:
  template <class Value>
  static Value Read(const std::string& key, const std::string& text) {
    if constexpr (std::is_same_v<Value, std::string>) {
      return text;
    } else if constexpr (std::is_same_v<Value, bool>) {
      if (text != "yes" && text != "no") Fail(key + " must be yes or no");
      return text == "yes";
    } else {
      std::istringstream stream(text);
      Value value{};
      if (!(stream >> value) || !(stream >> std::ws).eof())
        Fail(key + ": " + text + " is no number for it");
      return value;
    }
  }

  std::map<std::string, std::string> values_;
};

}  // namespace talus::bench
