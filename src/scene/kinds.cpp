#include "taut/scene/kinds.hpp"

namespace taut {
namespace {

/// The settings of a method by default, with what every method reads.
template <class Method>
MethodSettings settings_of(const Method& method, MethodKind type)
{
    MethodSettings out;
    out.type = type;
    out.substeps = method.substeps;
    out.iterations = method.iterations;
    out.precision = method.precision;
    return out;
}

/// A collider of a kind, with what all of them have.
template <class Value>
Collider collider_of(const Value& value, ColliderKind kind)
{
    Collider out;
    out.kind = kind;
    out.friction = value.friction;
    out.meets = value.meets;
    out.motion = value.motion;
    out.name = value.name;
    return out;
}

} // namespace

methods::Xpbd::operator MethodSettings() const { return settings_of(*this, MethodKind::xpbd); }

methods::Vbd::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::vbd);
    out.relaxation = relaxation;
    out.start = start;
    out.spectral_radius = spectral_radius;
    return out;
}

methods::Pbd::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::pbd);
    out.scheme = scheme;
    out.stretch = stretch;
    out.bend = bend;
    out.volume = volume;
    out.relaxation = relaxation;
    out.spectral_radius = spectral_radius;
    return out;
}

methods::MassSpring::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::mass_spring);
    out.integrator = integrator;
    out.stability = stability;
    out.scheme = scheme;
    return out;
}

methods::ImplicitEuler::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::implicit_euler);
    out.linear_iterations = linear_iterations;
    out.linear_tolerance = linear_tolerance;
    out.linear_operator = linear_operator;
    out.preconditioner = preconditioner;
    out.line_search = line_search;
    return out;
}

methods::ImplicitConstraints::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::implicit_constraints);
    out.integrator = integrator;
    out.stability = stability;
    out.linear_iterations = linear_iterations;
    out.linear_tolerance = linear_tolerance;
    out.linear_operator = linear_operator;
    out.constrained = constrained;
    out.constraint_compliance = constraint_compliance;
    return out;
}

methods::Acad::operator MethodSettings() const
{
    MethodSettings out = settings_of(*this, MethodKind::acad);
    out.integrator = integrator;
    out.stability = stability;
    out.linear_iterations = linear_iterations;
    out.linear_tolerance = linear_tolerance;
    out.constrained = constrained;
    out.constraint_compliance = constraint_compliance;
    out.activate_strain = activate_strain;
    out.release_strain = release_strain.value_or(activate_strain);
    out.release = release;
    out.target = target;
    out.compress = compress;
    return out;
}

shapes::Grid::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::grid;
    out.cells = cells;
    out.size = size;
    out.diagonals = diagonals;
    out.network = network;
    return out;
}

shapes::Chain::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::chain;
    out.links = links;
    out.length = length;
    out.width = width;
    return out;
}

shapes::Mesh::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::mesh;
    out.file = file;
    out.weld_distance = weld_distance;
    return out;
}

shapes::Box::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::box;
    out.box_cells = cells;
    out.box_size = size;
    out.split = split;
    return out;
}

shapes::Ball::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::ball;
    out.ball_cells = cells;
    out.radius = radius;
    return out;
}

shapes::Tetrahedra::operator Shape() const
{
    Shape out;
    out.kind = ShapeKind::tetrahedra;
    out.file = file;
    return out;
}

colliders::Plane::operator Collider() const
{
    Collider out = collider_of(*this, ColliderKind::plane);
    out.point = point;
    out.normal = normal;
    return out;
}

colliders::Sphere::operator Collider() const
{
    Collider out = collider_of(*this, ColliderKind::sphere);
    out.point = centre;
    out.radius = radius;
    return out;
}

colliders::Capsule::operator Collider() const
{
    Collider out = collider_of(*this, ColliderKind::capsule);
    out.point = from;
    out.end = to;
    out.radius = radius;
    return out;
}

colliders::Cuboid::operator Collider() const
{
    Collider out = collider_of(*this, ColliderKind::cuboid);
    out.point = centre;
    out.half_size = half_size;
    out.rotate_axis = rotate_axis;
    out.rotate_degrees = rotate_degrees;
    return out;
}

colliders::Field::operator Collider() const
{
    Collider out = collider_of(*this, ColliderKind::distance_field);
    out.field_file = file;
    out.field = field;
    out.field_scale = scale;
    out.point = origin;
    out.rotate_axis = rotate_axis;
    out.rotate_degrees = rotate_degrees;
    return out;
}

} // namespace taut
