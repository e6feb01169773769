// The table of particle fields: each per-particle array is declared once. From a row come allocation, the sort
// permutation, checkpoints, the state hash, the colour-by menu and the exports.
//
//   FIELD(name, type, unit, kept, model, carried or scratch, doc)
//
// Kept fields are sorted, saved and hashed; those of a model too, but only while its passes are planned: they begin at
// zero and cost nothing before. Carried and scratch fields exist only where a planned pass touches them. Carried ones
// are sorted, so that a picture finds what the last step left at its particle; the state does not depend on them.
// Scratch fields hold nothing from one step to the next but what the passes at the end of a step leave for those at the
// start of the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <string_view>
#include <vector>

#include "sim/core/vec.h"

namespace curlew {

#define CURLEW_FIELDS(FIELD)                                                                                          \
  FIELD(position, Vec3, "m", kept, "Where the particle is; w is not used.")                                           \
  FIELD(velocity, Vec3, "m/s", kept, "Velocity; w is not used.")                                                      \
  FIELD(id, std::uint32_t, "1", kept, "Number of the particle, the same for its whole life.")                         \
  FIELD(density_stiffness, float, "m^5/(kg s^2)", kept, "p / rho^2 of the density solve, carried as its warm start.") \
  FIELD(divergence_stiffness, float, "m^5/(kg s^2)", kept,                                                            \
        "p / rho^2 of the divergence solve, carried as its warm start.")                                              \
  FIELD(microrotation, Vec3, "1/s", model, "Spin of the particle, omega (Bender et al. 2018); w is not used.")        \
  FIELD(predicted_vorticity, Vec3, "1/s", model,                                                                      \
        "Vorticity that the flow has after the step if it loses none (Liu et al. 2020, Eq. 11); w: 1 where known.")   \
  FIELD(density, float, "kg/m^3", scratch, "SPH sum over fluid and boundary.")                                        \
  FIELD(diagonal, float, "kg^2/m^8", scratch,                                                                         \
        "|sum m grad W|^2 + sum |m grad W|^2, the diagonal of the pressure operator (DFSPH factor, inverted).")       \
  FIELD(neighbour_number, float, "1", scratch, "Fluid neighbours, boundary samples and what the walls stand for.")    \
  FIELD(boundary_gradient, Vec3, "kg/m^4", scratch,                                                                   \
        "Gradient of the density that boundaries add; w: that density itself, in kg/m^3.")                            \
  FIELD(boundary_friction, Vec3, "m/s^3", scratch,                                                                    \
        "Viscous pull of no-slip boundaries for nu = 1: xyz - w v is the acceleration, w in 1/m^2.")                  \
  FIELD(no_slip_gradient, Vec3, "kg/m^4", scratch, "The share of no-slip bodies in boundary_gradient.")               \
  FIELD(body_motion, Vec3, "kg/(m^3 s)", scratch,                                                                     \
        "What moving bodies take off the rate of change of density (w) and, no-slip ones, off the curl (xyz).")       \
  FIELD(acceleration, Vec3, "m/s^2", scratch, "What the forces, or a pressure iterate, do to the velocity.")          \
  FIELD(correction_diagonal, Vec3, "1", scratch, "xx, yy, zz of the kernel-gradient correction, see density.h.")      \
  FIELD(correction_mixed, Vec3, "1", scratch, "yz, zx, xy of the kernel-gradient correction.")                        \
  FIELD(corrected_diagonal, float, "kg^2/m^8", scratch,                                                               \
        "The diagonal of the pressure operator with the kernel-gradient correction.")                                 \
  FIELD(displacement, Vec3, "m", scratch,                                                                             \
        "Moves that are not velocity: density correction and shifting in filled domains.")                            \
  FIELD(pressure_acceleration, Vec3, "m/s^2", scratch,                                                                \
        "What the divergence solve did to the velocity, where it is to act twice.")                                   \
  FIELD(model_velocity, Vec3, "m/s", scratch,                                                                         \
        "What vorticity refinement adds to the velocity, where the energy guard may take it back.")                   \
  FIELD(model_acceleration, Vec3, "m/s^2", scratch,                                                                   \
        "The turbulence models' share in acceleration, where the energy guard may take it back.")                     \
  FIELD(packed, Vec3, "m", scratch, "Position with the pressure iterate in w: one load per neighbour.")               \
  FIELD(source, float, "kg/m^3", scratch, "Compression that a solve has to remove.")                                  \
  FIELD(iterate, float, "m^5/(kg s^2)", scratch, "Last iterate of a pressure solve, before momentum.")                \
  FIELD(pressure, float, "Pa", scratch,                                                                               \
        "Sum of both solves, rho^2 (k_density + k_divergence) times the gradient share.")                             \
  FIELD(vorticity, Vec3, "1/s", scratch, "Curl of the velocity, difference form (Liu et al. 2020, Eq. 6).")           \
  FIELD(lost_vorticity, Vec3, "1/s", carried,                                                                         \
        "Vorticity that the last step lost (Liu et al. 2020, Eq. 12); w: volume of the particle, m^D.")               \
  FIELD(                                                                                                              \
      sub_particles, Vec3, "1", model,                                                                                \
      "Vortex sub-particles (Fujisawa et al. 2011): turns of the pairs on level 0, 1, 2, from 0 to 1; w: the level.") \
  FIELD(wavelet_energy, float, "m^2/s^2", scratch,                                                                    \
        "Energy of the velocity at the scale of the particles (Fujisawa et al. 2011, Eq. 4, 6).")                     \
  FIELD(stream_function, Vec3, "m^2/s", scratch, "Vector potential of the lost velocity (Liu et al. 2020, Eq. 15).")

enum class FieldId : std::uint8_t {
#define CURLEW_ID(name, ...) name,
  CURLEW_FIELDS(CURLEW_ID)
#undef CURLEW_ID
};

enum class FieldKind : std::uint8_t { kept, model, carried, scratch };

// Goes where its particle goes: sorted.
constexpr bool is_state(FieldKind kind) { return kind != FieldKind::scratch; }
// Saved and hashed too.
constexpr bool is_saved(FieldKind kind) { return kind == FieldKind::kept || kind == FieldKind::model; }

// Sixty-four bytes: a cache line, and any SIMD register.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  bool operator==(const AlignedAllocator&) const = default;
};

template <class T>
using Array = std::vector<T, AlignedAllocator<T>>;

struct Fields {
#define CURLEW_MEMBER(name, type, ...) Array<type> name;
  CURLEW_FIELDS(CURLEW_MEMBER)
#undef CURLEW_MEMBER
};

struct FieldRow {
  FieldId id;
  std::string_view name, type, unit;
  FieldKind kind;
  std::string_view doc;
};

inline constexpr FieldRow field_table[] = {
#define CURLEW_ROW(name, type, unit, kind, doc) {FieldId::name, #name, #type, unit, FieldKind::kind, doc},
    CURLEW_FIELDS(CURLEW_ROW)
#undef CURLEW_ROW
};
inline constexpr std::size_t field_count = std::size(field_table);

// A set of fields, as passes declare them.
class FieldSet {
 public:
  constexpr FieldSet() = default;
  constexpr FieldSet(std::initializer_list<FieldId> ids) {
    for (FieldId id : ids) bits_ |= bit(id);
  }
  constexpr bool has(FieldId id) const { return (bits_ & bit(id)) != 0; }
  constexpr bool meets(FieldSet other) const { return (bits_ & other.bits_) != 0; }
  constexpr FieldSet operator|(FieldSet other) const { return FieldSet(bits_ | other.bits_); }
  constexpr FieldSet without(FieldSet other) const { return FieldSet(bits_ & ~other.bits_); }
  constexpr bool operator==(const FieldSet&) const = default;

  static constexpr FieldSet of(FieldKind kind) {
    FieldSet set;
    for (const FieldRow& row : field_table) {
      if (row.kind == kind) set.bits_ |= bit(row.id);
    }
    return set;
  }
  static constexpr FieldSet kept() { return of(FieldKind::kept); }

 private:
  constexpr explicit FieldSet(std::uint64_t bits) : bits_(bits) {}
  static constexpr std::uint64_t bit(FieldId id) { return std::uint64_t{1} << static_cast<int>(id); }
  std::uint64_t bits_ = 0;
};

// Calls f(row, array) for every field, in the order of the table.
template <class FieldsLike, class F>
void for_each_field(FieldsLike& fields, F&& f) {
#define CURLEW_CALL(name, ...) f(field_table[static_cast<std::size_t>(FieldId::name)], fields.name);
  CURLEW_FIELDS(CURLEW_CALL)
#undef CURLEW_CALL
}

}  // namespace curlew
