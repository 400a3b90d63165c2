#pragma once
#include "scene_text.h"

/// The only list of a scene's keys. visit() passes each key of an object to `fields`, which is a reader or a describer.
/// A reader takes the value from the JSON (scene_reader.h). A describer notes the key for the schema and the docs
/// (scene_describe.cpp).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The name of a type in the schema, and its description.
template <class T>
struct TypeText;
#define DETENT_TYPE_TEXT(type, type_name, text)      \
  template <>                                        \
  struct TypeText<type> {                            \
    static constexpr const char* k_name = type_name; \
    static constexpr const char* k_doc = text;       \
  }
DETENT_TYPE_TEXT(SceneText, "scene", "The whole file.");
DETENT_TYPE_TEXT(WorldDef, "world", "The world's settings, as in WorldDef.");
DETENT_TYPE_TEXT(Capacity, "capacity", "Room, as in Capacity. Omitted numbers are counted from the scene.");
DETENT_TYPE_TEXT(Material, "material", "How a surface behaves, as in Material.");
DETENT_TYPE_TEXT(Shape, "shape", "A shape in its body's frame, as in Shape.");
DETENT_TYPE_TEXT(Filter, "filter", "What a body collides with, as in Filter.");
DETENT_TYPE_TEXT(SceneBody, "body", "A body, as in BodyDef.");
DETENT_TYPE_TEXT(SceneJoint, "joint", "A joint, as in JointDef, given by a point, or by anchors and frames.");
DETENT_TYPE_TEXT(JointDef, "joint_changes", "What changes in a joint.");
DETENT_TYPE_TEXT(JointAxis, "axis", "A free motion of a joint, as in JointAxis: an angle, rad, or a length, m.");
DETENT_TYPE_TEXT(SceneQueryFilter, "query_filter", "Which bodies a query tests, as in QueryFilter.");
DETENT_TYPE_TEXT(SceneAction, "action", "A call before a tick, with the arguments of the function of this name.");
#undef DETENT_TYPE_TEXT

constexpr Range k_size = between(0x1p-14, 0x1p14);
constexpr Range k_size_or_zero = between(0, 0x1p14);

template <class F>
void visit(F& fields, Capacity& capacity) {
  const Range places = between(0, 1048576);
  fields.counted({"bodies", "at least 1", between(1, 1048576)}, capacity.bodies);
  fields.counted({"contacts", "pairs of bodies in contact", places}, capacity.contacts);
  fields.counted({"assets", "cooked files", places}, capacity.assets);
  fields.counted({"joints", "joints", places}, capacity.joints);
  fields.counted({"sensed", "pairs of a sensor and a body within it", places}, capacity.sensed);
  fields.flag({"manifolds", "room to recycle contact points"}, capacity.manifolds);
}

template <class F>
void visit(F& fields, WorldDef& world) {
  constexpr Choice<Stabilisation> k_stabilisations[] = {{"soft", Stabilisation::soft}, {"post", Stabilisation::post}};
  constexpr Choice<ManifoldReduction> k_reductions[] = {{"projected_extremes", ManifoldReduction::projected_extremes},
                                                        {"deepest_area", ManifoldReduction::deepest_area}};
  fields.object({"capacity", "room; set_settings does not change it"}, world.capacity);
  fields.vector({"gravity", "m/s^2", within(1024)}, world.gravity);
  fields.real({"tick", "the time of one step, s", between(0x1p-14, 0.25)}, world.tick);
  fields.integer({"substeps", "number per tick; 0: chosen for each island", between(0, 64)}, world.substeps);
  fields.integer({"substeps_max", "greatest number that is chosen", between(1, 64)}, world.substeps_max);
  fields.real({"resting_penetration", "depth of contacts at rest, divided by the smaller extent of the two bodies",
               between(0x1p-12, 0x1p-3)},
              world.resting_penetration);
  fields.integer({"iterations", "sweeps over the contacts per substep", between(1, 64)}, world.iterations);
  fields.integer(
      {"convergence", "sweeps end early when no velocity changes by more than 2^-convergence of gravity x substep",
       between(0, 30)},
      world.convergence);
  fields.choice({"stabilisation", "how overlap is removed"}, world.stabilisation, k_stabilisations);
  fields.real({"relaxation", "over-relaxation factor of the SOR solver", between(0.25, 1.75)}, world.relaxation);
  fields.real({"contact_frequency", "frequency of soft contacts, divided by the substep rate", between(1.0 / 64, 0.25)},
              world.contact_frequency);
  fields.real({"damping_ratio", "of the soft contacts", between(0, 64)}, world.damping_ratio);
  fields.real({"restitution_threshold", "slowest rebound, in sqrt(g x smaller extent)", between(0, 64)},
              world.restitution_threshold);
  fields.flag({"continuous", "no body passes through another"}, world.continuous);
  fields.flag({"sleeping", "bodies at rest fall asleep"}, world.sleeping);
  fields.real({"contact_margin", "greatest gap of contact points, divided by the smaller extent of the two bodies",
               between(0x1p-10, 0x1p-4)},
              world.contact_margin);
  fields.real({"contact_recycle_distance",
               "motion up to which contact points are recycled, divided by the smaller extent of the two bodies",
               between(0, 1.0 / 64)},
              world.contact_recycle_distance);
  fields.choice({"reduction", "which contact points are kept"}, world.reduction, k_reductions);
}

template <class F>
void visit(F& fields, Material& material) {
  constexpr Choice<RestitutionRule> k_rules[] = {{"larger", RestitutionRule::larger},
                                                 {"smaller", RestitutionRule::smaller}};
  fields.real({"friction", "Coulomb's coefficient", between(0, 16)}, material.friction);
  fields.real({"restitution", "rebound speed over approach speed", between(0, 1)}, material.restitution);
  fields.real(
      {"rolling_resistance", "greatest torque, divided by (normal force x half the smaller extent of the two bodies)",
       between(0, 16)},
      material.rolling_resistance);
  fields.choice({"restitution_rule", "which of two restitutions a pair takes; one `smaller` decides"},
                material.restitution_rule, k_rules);
}

template <class F>
void visit(F& fields, Shape& shape) {
  constexpr Choice<ShapeType> k_types[] = {
      {"sphere", ShapeType::sphere},         {"capsule", ShapeType::capsule},   {"box", ShapeType::box},
      {"cylinder", ShapeType::cylinder},     {"cone", ShapeType::cone},         {"hull", ShapeType::hull},
      {"half_space", ShapeType::half_space}, {"compound", ShapeType::compound}, {"terrain", ShapeType::terrain},
  };
  if (!fields.tag({"type", "which shape"}, shape.type, k_types)) return;
  const SceneField rounding = {"rounding", "radius of the rounding, by which the shape grows, m; 0, or a size",
                               k_size_or_zero};
  const SceneField half_length = required({"half_length", "along y, m: half of the height", k_size});
  switch (shape.type) {
    case ShapeType::sphere:
      fields.real(required({"radius", "m", k_size}), shape.radius);
      break;
    case ShapeType::capsule:
      fields.real(required({"radius", "m", k_size}), shape.radius);
      fields.real(required({"half_length", "of the core along y, m", k_size_or_zero}), shape.half_length);
      break;
    case ShapeType::box:
      fields.vector(required({"half_extents", "m", k_size}), shape.half_extents);
      fields.real(rounding, shape.rounding);
      break;
    case ShapeType::cylinder:
    case ShapeType::cone:
      fields.real(required({"radius", "m; for a cone, of its base", k_size}), shape.radius);
      fields.real(half_length, shape.half_length);
      fields.real(rounding, shape.rounding);
      break;
    case ShapeType::hull:
      fields.asset(shape);
      fields.real(rounding, shape.rounding);
      break;
    case ShapeType::compound:
    case ShapeType::terrain:
      fields.asset(shape);
      break;
    default:  // a half-space has no dimensions; a triangle is not among the choices
      break;
  }
}

template <class F>
void visit(F& fields, Filter& filter) {
  fields.integer({"category", "bits: what the body is", k_word}, filter.category);
  fields.integer({"mask", "bits: the categories that it touches", k_word}, filter.mask);
  fields.integer({"group", "two bodies of the same group always collide if it is positive, and never if it is negative",
                  between(-2147483648.0, 2147483647.0)},
                 filter.group);
}

template <class F>
void type_of_body(F& fields, BodyType& type, bool needed) {
  constexpr Choice<BodyType> k_types[] = {
      {"fixed", BodyType::fixed}, {"kinematic", BodyType::kinematic}, {"dynamic", BodyType::dynamic}};
  fields.choice({"type", "how it moves", k_any, needed}, type, k_types);
}

template <class F>
void rotation_locks_of_body(F& fields, uint32_t& locks, bool needed) {
  constexpr Choice<uint32_t> k_locks[] = {{"x", k_rotation_lock_x}, {"y", k_rotation_lock_y}, {"z", k_rotation_lock_z}};
  fields.choices({"rotation_locks", "body axes about which it does not rotate", k_any, needed}, locks, k_locks);
}

template <class F>
void visit(F& fields, SceneBody& body) {
  BodyDef& def = body.def;
  fields.origin(body.origin);
  fields.repeated();
  fields.text({"name", "for joints, actions and the output"}, body.name);
  type_of_body(fields, def.type, false);
  fields.position({"position", "of the centre of mass, m, world"}, def.position);
  fields.rotation({"rotation", "local to world"}, def.rotation);
  fields.vector({"linear_velocity", "m/s, world", within(16384)}, def.linear_velocity);
  fields.vector({"angular_velocity", "rad/s, world; its length x bounding radius within 16384 m/s"},
                def.angular_velocity);
  fields.named(required({"shape", "in its frame, about its centre of mass"}), def.shape);
  fields.named({"material", "of the whole surface"}, def.material);
  fields.scaled({"density", "kg/m^3; used if no mass is given", above(0)}, def.density);
  fields.scaled({"mass", "kg; 0: from the density", at_least(0)}, def.mass);
  fields.real({"linear_damping", "1/s", between(0, 1024)}, def.linear_damping);
  fields.real({"angular_damping", "1/s", between(0, 1024)}, def.angular_damping);
  fields.real({"gravity_scale", "times the world's gravity", within(1024)}, def.gravity_scale);
  fields.integer({"user_data", "kept and recorded", k_word}, def.user_data);
  rotation_locks_of_body(fields, def.rotation_locks, false);
  fields.named({"filter", "what it collides with"}, def.filter);
  fields.flag({"sensor", "it applies no forces, and reports the bodies inside it"}, def.sensor);
  if (def.type == BodyType::dynamic &&
      (def.shape.type == ShapeType::half_space || def.shape.type == ShapeType::terrain)) {
    fields.problem("type", "is dynamic, which a half-space or terrain cannot be");
  }
}

template <class F>
void visit(F& fields, JointAxis& axis) {
  fields.flag({"limited", "whether the limits apply"}, axis.limited);
  fields.real({"lower", "rad or m", within(16384)}, axis.lower);
  fields.real({"upper", "rad or m; not below lower", within(16384)}, axis.upper);
  fields.real({"frequency", "of the spring, Hz; 0: none", between(0, 1024)}, axis.frequency);
  fields.real({"damping_ratio", "of the spring; 1 is critical", between(0, 64)}, axis.damping_ratio);
  fields.real({"target", "of the spring, rad or m", within(16384)}, axis.target);
  fields.real({"speed", "of the motor, rad/s or m/s", within(1024)}, axis.speed);
  fields.scaled({"force_max", "N or N m; of a motor, 0: no motor; of a spring, 0: no bound", at_least(0)},
                axis.force_max);
}

template <class F>
void visit(F& fields, JointDef& def) {
  constexpr Choice<JointType> k_types[] = {
      {"ball", JointType::ball},         {"hinge", JointType::hinge},       {"slider", JointType::slider},
      {"distance", JointType::distance}, {"fixed", JointType::fixed},       {"cone_twist", JointType::cone_twist},
      {"wheel", JointType::wheel},       {"parallel", JointType::parallel}, {"filter", JointType::filter}};
  fields.choice({"type", "which motions are free"}, def.type, k_types);
  fields.vector({"anchor_a", "from A's centre of mass, m, A's axes", within(4096)}, def.anchor_a);
  fields.vector({"anchor_b", "from B's centre of mass, m, B's axes", within(4096)}, def.anchor_b);
  fields.rotation({"frame_a", "from the frame's axes to A's"}, def.frame_a);
  fields.rotation({"frame_b", "from the frame's axes to B's"}, def.frame_b);
  fields.object({"axis", "the first free motion"}, def.axis);
  fields.object({"second", "the second free motion"}, def.second);
  fields.scaled({"friction_force", "N: against free sliding", at_least(0)}, def.friction_force);
  fields.scaled({"friction_torque", "N m: against the free rotations", at_least(0)}, def.friction_torque);
  fields.flag({"collide", "whether A and B collide with each other"}, def.collide);
  fields.scaled({"break_force", "N; 0: never", at_least(0)}, def.break_force);
  fields.scaled({"break_torque", "N m; 0: never", at_least(0)}, def.break_torque);
  fields.integer({"user_data", "kept and recorded", k_word}, def.user_data);
}

template <class F>
void visit(F& fields, SceneJoint& joint) {
  fields.origin(joint.origin);
  fields.repeated();
  fields.text({"name", "for actions and the output"}, joint.name);
  fields.body(required({"a", "the first body; for a wheel, the chassis"}), joint.a);
  fields.body(required({"b", "the second body, which rotates or slides on A"}), joint.b);
  if (!joint.a.empty() && joint.a == joint.b) fields.problem("b", "is `a`, too");
  joint.placed =
      fields.position(optional({"point", "its anchor, m, world; the joint starts without error"}), joint.point);
  const bool framed = fields.rotation({"frame", "with `point`: from the frame's axes to the world's"}, joint.frame);
  visit(fields, joint.def);
  if (framed && !joint.placed) fields.problem("frame", "goes with `point`");
  for (const char* key : {"anchor_a", "anchor_b", "frame_a", "frame_b"}) {
    if (joint.placed && fields.given(key)) fields.problem(key, "does not go with `point`");
  }
}

template <class F>
void visit(F& fields, SceneQueryFilter& asked) {
  fields.integer({"category", "bits: what the query is", k_word}, asked.filter.category);
  fields.integer({"mask", "bits: the categories that it tests", k_word}, asked.filter.mask);
  fields.body({"ignore", "a body that is not tested"}, asked.ignore);
}

template <class F>
void visit(F& fields, SceneText& scene) {
  fields.integer(required({"format", "version of this format", between(1, 1)}), scene.format);
  fields.text({"$schema", "for editors; not read"}, scene.schema);
  fields.text({"description", "one line"}, scene.description);
  fields.integer({"ticks", "number of ticks, unless --ticks gives another", between(0, 1e9)}, scene.ticks);
  fields.object({"world", "settings of the world"}, scene.world);
  fields.dictionary({"materials", "for bodies, by name"}, scene.materials);
  fields.dictionary({"shapes", "for bodies, by name"}, scene.shapes);
  fields.dictionary({"filters", "for bodies, by name"}, scene.filters);
  fields.list({"bodies", "created at the start, in this order"}, scene.bodies);
  fields.list({"joints", "created after the bodies, in this order"}, scene.joints);
  fields.list({"actions", "calls before ticks, for one tick in this order"}, scene.actions);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
