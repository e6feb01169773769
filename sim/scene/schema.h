// The JSON schema of scene files.
#pragma once

#include <string>

namespace curlew {

// Draft 2020-12, with every parameter's range and documentation from the table. `curlew params --schema` prints it and
// assets/scene.schema.json is it.
std::string scene_schema();

}  // namespace curlew
