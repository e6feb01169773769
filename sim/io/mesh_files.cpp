#include "sim/io/mesh_files.h"

#include <bit>
#include <charconv>
#include <cstring>

#include "sim/core/params.h"
#include "sim/io/atomic_file.h"
#include "sim/io/particle_columns.h"

namespace curlew {
namespace {

std::string origin_text(double time, std::int64_t step) {
  return "Curlew, time " + number_text(time) + " s, step " + std::to_string(step);
}

void append_vector(std::string& bytes, Vec3 a) {
  for (int axis = 0; axis < 3; ++axis) append_number(bytes, a[axis], std::endian::little);
}

// Text that goes to the file in pieces.
class TextOut {
 public:
  explicit TextOut(AtomicFile& file) : file_(file) {}

  TextOut& add(std::string_view text) {
    text_ += text;
    return *this;
  }
  template <class T>
  TextOut& add_number(T value) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }
  void end_line() {
    text_ += '\n';
    if (text_.size() > 60000) flush();
  }
  void flush() {
    file_.write(text_);
    text_.clear();
  }

 private:
  AtomicFile& file_;
  std::string text_;
};

}  // namespace

void write_mesh_ply(const std::string& path, const SurfaceMesh& mesh, double time, std::int64_t step) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + origin_text(time, step) + "\nelement vertex " +
                     std::to_string(mesh.position.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"}) {
    if (name[0] != 'v' || !mesh.velocity.empty()) text += std::string("property float ") + name + "\n";
  }
  text += "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty list uchar uint vertex_indices\nend_header\n";
  AtomicFile file(path);
  const auto flush_from = [&](std::size_t size) {
    if (text.size() < size) return;
    file.write(text);
    text.clear();
  };
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    append_vector(text, mesh.position[v]);
    append_vector(text, mesh.normal[v]);
    if (!mesh.velocity.empty()) append_vector(text, mesh.velocity[v]);
    flush_from(60000);
  }
  for (const auto& triangle : mesh.triangles) {
    text += '\3';
    for (const std::uint32_t v : triangle) append_number(text, v, std::endian::little);
    flush_from(60000);
  }
  flush_from(0);
  file.commit();
}

void write_mesh_obj(const std::string& path, const SurfaceMesh& mesh, double time, std::int64_t step) {
  AtomicFile file(path);
  TextOut out(file);
  out.add("# ").add(origin_text(time, step)).end_line();
  out.add("o water").end_line();
  const auto vectors = [&](const char* keyword, const std::vector<Vec3>& all) {
    for (const Vec3& a : all) {
      out.add(keyword);
      for (int axis = 0; axis < 3; ++axis) out.add(" ").add_number(a[axis]);
      out.end_line();
    }
  };
  vectors("v", mesh.position);
  vectors("vn", mesh.normal);
  for (const auto& triangle : mesh.triangles) {
    out.add("f");
    for (const std::uint32_t v : triangle) out.add(" ").add_number(v + 1).add("//").add_number(v + 1);
    out.end_line();
  }
  out.flush();
  file.commit();
}

}  // namespace curlew
