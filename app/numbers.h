// Numbers as people write them on a command line.
#pragma once

#include <string>

namespace curlew {

// "24k", "1.2M", "1e5": a number of at least one, with an optional thousand or million. Throws InputError; `option`
// begins the message.
double parse_particle_number(const std::string& option, const std::string& text);

}  // namespace curlew
