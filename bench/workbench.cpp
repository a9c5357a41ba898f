// SPDX-License-Identifier: Apache-2.0
// The shared parts are made on demand, so that a filtered run is quick.
#include "workbench.h"

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace sobb::bench {
namespace {

constexpr uint32_t kAllThreads = 0;

}  // namespace

Workbench::Workbench(const Flags& flags)
    : flags_(flags),
      scene_(flags.scene, flags.cameras, flags.view),
      workers_(static_cast<int>(flags.threads)) {}

Workbench::~Workbench() {
  std::error_code ignored;  // a file left in the temporary folder harms nobody
  if (!saved_file_.empty()) std::filesystem::remove_all(saved_file_.parent_path(), ignored);
}

const SobbSubject& Workbench::subject(Method method) {
  const auto found = subjects_.find(method);
  if (found != subjects_.end()) return found->second;
  return subjects_.emplace(method, SobbSubject(scene_, method, flags_, kAllThreads)).first->second;
}

Peer& Workbench::peer(Method method) {
  const auto found = peers_.find(method);
  if (found != peers_.end()) return *found->second;
  std::unique_ptr<Peer> peer(peer_library()->make(scene_, method, flags_, kAllThreads));
  return *peers_.emplace(method, std::move(peer)).first->second;
}

const RaySet& Workbench::rays(RayKind kind) {
  const auto found = ray_sets_.find(kind);
  if (found != ray_sets_.end()) return found->second;
  RaySet set = make_rays(kind);
  if (set.rays.empty()) {
    throw std::runtime_error("no primary ray of this view gives a " + name_of(kind) + " ray");
  }
  return ray_sets_.emplace(kind, std::move(set)).first->second;
}

RaySet Workbench::make_rays(RayKind kind) {
  switch (kind) {
    case RayKind::kShadow:
      return shadow_rays(scene_.view(), surface());
    case RayKind::kDiffuse1:
      return diffuse_rays(surface());
    case RayKind::kDiffuse7:
      // A quarter of the paths, since each is several rays.
      return path_rays(scene_.triangles(), scene_.info(),
                       primary_rays(scene_.view(), (flags_.size + 1) / 2), 7,
                       [this](const RaySet& set) { return closest_hits(set); });
    case RayKind::kRandom:
      return random_rays(scene_.info(), (size_t{flags_.size} * flags_.size + 3) / 4);
    case RayKind::kPrimary:
      break;
  }
  return primary_rays(scene_.view(), flags_.size);
}

std::vector<sobb_hit> Workbench::closest_hits(const RaySet& set) {
  TraceOutput output;
  output.resize(set);
  subject(Method::kSobb).trace(set, Call::kArray, workers_, output);
  return std::move(output.hits);
}

Surface Workbench::surface() {
  const RaySet& primary = rays(RayKind::kPrimary);
  return surface_of(scene_.triangles(), scene_.info(), primary, closest_hits(primary));
}

const WorkPerRay& Workbench::work(RayKind kind, Method method) {
  const std::pair key(kind, method);
  if (!work_.contains(key)) work_[key] = subject(method).count_work(rays(kind));
  return work_[key];
}

const std::filesystem::path& Workbench::saved_file() {
  if (saved_file_.empty()) {
    std::string folder = std::filesystem::temp_directory_path() / "sobb_bench.XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), "cannot make " + folder);
    }
    saved_file_ = std::filesystem::path(folder) / "scene.sobb";
    subject(Method::kSobb).save(saved_file_.string());
  }
  return saved_file_;
}

}  // namespace sobb::bench
