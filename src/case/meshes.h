#pragma once

#include <memory>
#include <optional>
#include <span>

#include "subimpact/case/case.h"

namespace subimpact {

/// All that the program has to decide by mesh, in one row per mesh. A new mesh is its own files, an
/// enumerator of MeshKind and a row in meshes.cpp.
struct MeshDescriptor {
  MeshKind kind;
  const char* name;  ///< in case files
  const char* note;  ///< what it is for

  std::span<const char* const> keys;  ///< that have an effect with this mesh and not with all
  bool bends = true;                  ///< whether sections may yield
  /// Whether the mesh models beams of that theory.
  bool (*suits)(const Beam& beam) = [](const Beam&) { return true; };

  /// Whether strike and supports go together with the mesh. Throws InvalidCase.
  void (*check)(const Case& input);
  /// Throws InvalidCase where the scene cannot be modelled.
  std::shared_ptr<const BeamMesh> (*make)(const Case& input);

  /// How the mesh is refined; nothing for one that has no error.
  struct Refinement {
    int ModelOptions::*count;  ///< of equal parts over the whole length
    const char* key;           ///< of that count
    const char* parts;         ///< "cells"
    int fewest;
    bool odd_in_half;  ///< whether a half model needs an odd count; else an even one
    double (*size)(const Case& input);  ///< of a part, m
    /// Order in which times of events converge.
    int (*order)(const Case& input);
  };
  std::optional<Refinement> refinement = {};
};

std::span<const MeshDescriptor> meshes();
const MeshDescriptor& descriptor_of(MeshKind kind);

/// Throws InvalidCase if the mesh does not suit the beam's theory, or as its descriptor's check().
void check_mesh(const Case& input);

bool strikes_end(const Case& input);

/// More parts of a mesh whose size is open, where a strike close to an end needs them.
void make_room_for_strike(Case& input);

/// Cells, but for a strike at an end: a mesh with a node there.
MeshKind default_mesh(const Case& input);

/// Whether the mesh of a case uses a key of [model] that not all meshes use.
bool mesh_uses(const Case& input, const char* key);

}  // namespace subimpact
