// The command line (README, "Command line").
#pragma once

namespace curlew {

// Parses, runs the command and returns its exit code. Throws what the command throws, and InputError for bad usage.
int dispatch(int argc, char** argv);

}  // namespace curlew
