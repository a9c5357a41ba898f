// SPDX-License-Identifier: Apache-2.0
// What the process has to know of worker threads that live on when a loop has ended.
#pragma once

namespace sobb {

// Keeps the library in the process for good, and notices forks. To be called before a loop may
// start a worker.
void prepare_for_workers();

// Returns whether this process is the child of a fork whose parent had started workers. The child
// has none of them, and one may have held a lock of theirs, so it runs loops on the calling thread.
bool workers_are_gone();

}  // namespace sobb
