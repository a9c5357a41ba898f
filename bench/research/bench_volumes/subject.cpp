// SPDX-License-Identifier: Apache-2.0
// Names the methods, and lists what a run converts.
#include "bench_volumes/subject.h"

#include <cctype>

#include "circumstances.h"

namespace sobb::bench::volumes {
namespace {

// Strategy k3 has too many triples for whole hierarchies of more planes: only k2 is compared there.
constexpr uint32_t kMostPlanesOfAnyStrategy = 64;

// "SOBB 64i" becomes sobb64i.
std::string method_name(const study::Method& method) {
  std::string name;
  for (const char c : method.name) {
    if (c != ' ') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

}  // namespace

std::string layout_name(uint32_t width) { return width == 2 ? "binary" : "wide"; }

std::string Subject::name() const {
  std::string name = method_name(settings.method) + "/" + layout_name(settings.width);
  if (settings.method.has_strategy()) name += "/" + strategy_name(settings.strategy);
  return name;
}

std::vector<study::ConvertSettings> settings_of(const Options& options, uint32_t width) {
  std::vector<study::ConvertSettings> all;
  for (const study::Method& method : study::kMethods) {
    const bool choice = method.has_strategy() && method.k <= kMostPlanesOfAnyStrategy;
    for (const sobb_strategy strategy :
         choice ? options.strategies : std::vector{SOBB_STRATEGY_K2}) {
      all.push_back({method, width, strategy, options.isa});
    }
  }
  return all;
}

}  // namespace sobb::bench::volumes
