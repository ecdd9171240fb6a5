// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// The C++17 layer of embound, header only: handles that free themselves, views instead of pointer
/// and size, exceptions instead of statuses. It adds nothing to the C functions of embound.h, which
/// remains the reference for what each of them means and may be mixed in at any point:
/// `Geometry::get()` lends the C handle, `Geometry(handle)` adopts one.
///
///     embound::Mesh mesh = embound::Mesh::read("bracket.stl");
///     embound::Geometry body = embound::from_mesh(mesh);
///     double distance = body(x, y, z);                         // negative inside, positive outside
///     std::vector<double> levels = body.fill(embound::Lattice(xs, ys, zs));
///
/// An exception thrown by a function of yours that embound calls (an implicit function, a progress
/// callback, an executor) reaches you as it was thrown.
#ifndef EMBOUND_HPP
#define EMBOUND_HPP

#include "embound/bounding.hpp"
#include "embound/combine.hpp"
#include "embound/data.hpp"
#include "embound/diagnosis.hpp"
#include "embound/error.hpp"
#include "embound/function.hpp"
#include "embound/geometry.hpp"
#include "embound/grid.hpp"
#include "embound/mesh.hpp"
#include "embound/pack.hpp"
#include "embound/rays.hpp"
#include "embound/repair.hpp"
#include "embound/run.hpp"
#include "embound/shapes.hpp"
#include "embound/topology.hpp"
#include "embound/transforms.hpp"
#include "embound/views.hpp"

#ifdef _OPENMP
#include "embound/openmp.hpp"
#endif

#endif
