// Ctrl-C (SIGINT) and SIGTERM: a run ends with the step in hand. A second one ends the program at once.
#pragma once

namespace curlew {

void watch_for_interrupt();
bool interrupted();

}  // namespace curlew
