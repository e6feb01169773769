// The commands of the program. Each returns its exit code and throws what the user did wrong as InputError.
#pragma once

#include <string>

#include "app/options.h"

namespace curlew {

int run_command(const RunOptions& options);
int check_command(const RunOptions& options);
int scenes_command();
enum class ParameterFormat { text, json, markdown, schema };
int params_command(ParameterFormat format);
int doctor_command();
int mesh_command(const RedoOptions& options);
int render_command(const RedoOptions& options);
int compare_command(const CompareOptions& options);
int bench_command(const BenchOptions& options);
// The window; of the options it heeds scene, settings, resolution, threads and seed.
int gui_command(const RunOptions& options);

std::string version_text();

}  // namespace curlew
