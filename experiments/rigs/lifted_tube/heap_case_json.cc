#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "experiments/rigs/lifted_tube/heap_case.h"

namespace talus::rigs {

HeapCase LoadHeapCase(const std::filesystem::path& path) {
  return LoadHeapCase(base::ReadJsonFile(path));
}

HeapCase LoadHeapCase(const base::JsonFile& file) {
  auto heap_case = base::LoadOptions<HeapCase>(file);
  if (heap_case.powder.sizes.kind != engine::SizeKind::kFile) return heap_case;
  engine::ReadSizeFile(heap_case.powder.sizes);
  base::Problems problems(file.path.string(), file.places);
  heap_case.Validate(problems);  // what only the sizes can tell
  problems.ThrowIfAny();
  return heap_case;
}

std::string HeapCaseText(const HeapCase& heap_case) {
  return base::JsonText(base::ToJson(heap_case), 2) + "\n";
}

bool IsSameRun(const HeapCase& a, const HeapCase& b) {
  const auto run = [](HeapCase c) {
    c.outputs = {};
    c.frame.reset();
    c.num_views = 1;
    c.threads = 1;
    c.checkpoint_interval = 0;
    return HeapCaseText(c);
  };
  return run(a) == run(b);
}

}  // namespace talus::rigs
