// SPDX-License-Identifier: Apache-2.0
// The methods and their names.
#include "bench_volumes/subject.h"

#include <cctype>

namespace sobb::bench::volumes {
namespace {

// Beyond it the triples of k3 are too many for whole hierarchies, so one strategy serves to
// compare.
constexpr uint32_t kMostPlanesOfAnyStrategy = 64;

// "SOBB 64i" is sobb64i.
std::string method_name(const study::Method& method) {
  std::string name;
  for (const char c : method.name) {
    if (c != ' ') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

std::string strategy_name(sobb_strategy strategy) {
  return strategy == SOBB_STRATEGY_K ? "k" : strategy == SOBB_STRATEGY_K3 ? "k3" : "k2";
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
