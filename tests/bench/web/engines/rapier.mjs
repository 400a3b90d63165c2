/** Rapier, of one of its packages. */

import { icosahedronPoints } from '../depth.mjs';

export async function rapier({ name, source }) {
  const api = (await import(source)).default;
  await api.init();
  const vector = ([x, y, z]) => ({ x, y, z });
  const quaternion = ([x, y, z, w]) => ({ x, y, z, w });
  const shapes = {
    box: ({ halfExtents }) => api.ColliderDesc.cuboid(...halfExtents),
    sphere: ({ radius }) => api.ColliderDesc.ball(radius),
    capsule: ({ radius, half }) => api.ColliderDesc.capsule(half, radius),
    icosahedron: ({ radius }) => api.ColliderDesc.convexHull(new Float32Array(icosahedronPoints(radius).flat())),
  };

  return {
    name,
    version: api.version(),
    create(scene) {
      const world = new api.World({ x: 0, y: -9.81, z: 0 });
      const bodies = scene.bodies.map(({ shape, position, rotation, density, fixed }) => {
        const desc = fixed ? api.RigidBodyDesc.fixed() : api.RigidBodyDesc.dynamic();
        const body = world.createRigidBody(
          desc
            .setTranslation(...position)
            .setRotation(quaternion(rotation))
            .setCanSleep(false),
        );
        const collider = shapes[shape.kind](shape).setDensity(density).setFriction(0.6);
        if (scene.collisions === false) collider.setCollisionGroups(0);
        world.createCollider(collider, body);
        return body;
      });
      for (const { type, a, b, anchorA, anchorB, lower, upper } of scene.joints) {
        const [from, to] = [vector(anchorA), vector(anchorB)];
        const data =
          type === 'hinge' ? api.JointData.revolute(from, to, { x: 1, y: 0, z: 0 }) : api.JointData.spherical(from, to);
        const joint = world.createImpulseJoint(data, bodies[a], bodies[b], true);
        joint.setContactsEnabled(false);
        if (type === 'hinge') joint.setLimits(lower, upper);
      }
      return {
        step: () => world.step(),
        poses: () =>
          bodies.map((body) => {
            const [p, q] = [body.translation(), body.rotation()];
            return { position: [p.x, p.y, p.z], rotation: [q.x, q.y, q.z, q.w] };
          }),
        settings: () => ({
          timestep: world.timestep,
          solverIterations: world.numSolverIterations,
          internalPgsIterations: world.numInternalPgsIterations,
        }),
        destroy: () => world.free(),
      };
    },
  };
}
