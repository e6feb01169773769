// The ways in which Curlew gives up. Every message is one sentence for the user; main() maps the types to exit codes
// 2, 3 and 4.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace curlew {

// Bad usage, scene or file: the sentence names the file, the place, what was found and what was expected.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The simulation left the range in which it means anything.
struct DivergedError : std::runtime_error {
  DivergedError(const std::string& sentence, std::string pass_name, std::uint32_t particle_id)
      : std::runtime_error(sentence), pass(std::move(pass_name)), particle(particle_id) {}
  std::string pass;
  std::uint32_t particle;
};

// No display or no OpenGL where one was asked for.
struct GraphicsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace curlew
