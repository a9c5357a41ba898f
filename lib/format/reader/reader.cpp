// SPDX-License-Identifier: Apache-2.0
#include "format/reader/reader.h"

#include "bounds/directions/direction_table.h"
#include "format/reader/validate.h"

namespace sobb {

FileView read_image(std::span<const std::byte> bytes, const char* name, const Scheduler& scheduler,
                    std::pmr::memory_resource& scratch, Progress& progress) {
  const Reading reading{bytes, name, scheduler, scratch, progress};
  validate_sections(reading, validate_header(reading));
  FileView view = view_of(bytes);
  validate_directions(reading, view);
  view.table = table_of_file(view.directions);
  validate_record(reading, view);
  validate_blocks(reading, view);
  validate_nodes(reading, view);
  validate_tree(reading, view);
  return view;
}

}  // namespace sobb
