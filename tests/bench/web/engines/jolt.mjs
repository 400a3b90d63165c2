/** Jolt, of the package jolt-physics: its build for one thread. */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { icosahedronPoints } from '../depth.mjs';

export async function jolt({ name }) {
  const api = await (await import('jolt-physics/wasm-compat')).default();
  const { version } = JSON.parse(readFileSync(createRequire(import.meta.url).resolve('jolt-physics/package.json')));
  const [fixedLayer, movingLayer] = [0, 1];
  // The greatest convex radius is half an extent, as it is by default for a box of 10 cm and more.
  const radiusOf = (halfExtents) => Math.min(0.05, Math.min(...halfExtents) / 2);
  const made = (settings) => {
    const shape = settings.Create().Get();
    shape.AddRef();
    return shape;
  };
  const shapes = {
    box: ({ halfExtents }) => new api.BoxShapeSettings(new api.Vec3(...halfExtents), radiusOf(halfExtents)),
    sphere: ({ radius }) => new api.SphereShapeSettings(radius),
    capsule: ({ radius, half }) => new api.CapsuleShapeSettings(half, radius),
    icosahedron: ({ radius }) => {
      const settings = new api.ConvexHullShapeSettings();
      for (const point of icosahedronPoints(radius)) settings.mPoints.push_back(new api.Vec3(...point));
      return settings;
    },
  };

  /** Layers: what is fixed does not collide with itself; without collisions nothing does. */
  function interfaceOf(collisions) {
    const pairs = new api.ObjectLayerPairFilterTable(2);
    if (collisions) {
      pairs.EnableCollision(fixedLayer, movingLayer);
      pairs.EnableCollision(movingLayer, movingLayer);
    }
    const broad = new api.BroadPhaseLayerInterfaceTable(2, 2);
    for (const layer of [fixedLayer, movingLayer])
      broad.MapObjectToBroadPhaseLayer(layer, new api.BroadPhaseLayer(layer));
    const settings = new api.JoltSettings();
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = broad;
    settings.mObjectVsBroadPhaseLayerFilter = new api.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 2);
    return new api.JoltInterface(settings);
  }

  return {
    name,
    version,
    create(scene) {
      const engine = interfaceOf(scene.collisions !== false);
      const system = engine.GetPhysicsSystem();
      system.SetGravity(new api.Vec3(0, -9.81, 0));
      const bodyInterface = system.GetBodyInterface();
      const parts = 1 + Math.max(0, ...scene.bodies.map(({ part }) => part ?? 0));
      const apart = new api.GroupFilterTable(parts); // the two bodies of a joint
      apart.AddRef();
      for (const { a, b } of scene.joints) {
        const [first, second] = [scene.bodies[a], scene.bodies[b]];
        if (first.figure !== undefined) apart.DisableCollision(first.part, second.part);
      }
      const bodies = scene.bodies.map(({ shape, position, rotation, density, fixed, figure, part }) => {
        const shapeSettings = shapes[shape.kind](shape);
        shapeSettings.mDensity = density;
        const settings = new api.BodyCreationSettings(
          made(shapeSettings),
          new api.RVec3(...position),
          new api.Quat(...rotation),
          fixed ? api.EMotionType_Static : api.EMotionType_Dynamic,
          fixed ? fixedLayer : movingLayer,
        );
        settings.mFriction = 0.6;
        settings.mLinearDamping = 0;
        settings.mAngularDamping = 0;
        settings.mAllowSleeping = false;
        if (figure !== undefined) settings.mCollisionGroup = new api.CollisionGroup(apart, figure, part);
        const body = bodyInterface.CreateBody(settings);
        bodyInterface.AddBody(body.GetID(), api.EActivation_Activate);
        return body;
      });
      for (const { type, a, b, anchorA, anchorB, lower, upper } of scene.joints) {
        const settings = type === 'hinge' ? new api.HingeConstraintSettings() : new api.PointConstraintSettings();
        settings.mSpace = api.EConstraintSpace_LocalToBodyCOM;
        settings.mPoint1 = new api.RVec3(...anchorA);
        settings.mPoint2 = new api.RVec3(...anchorB);
        if (type === 'hinge') {
          settings.mHingeAxis1 = settings.mHingeAxis2 = new api.Vec3(1, 0, 0);
          settings.mNormalAxis1 = settings.mNormalAxis2 = new api.Vec3(0, 1, 0);
          settings.mLimitsMin = lower;
          settings.mLimitsMax = upper;
        }
        system.AddConstraint(settings.Create(bodies[a], bodies[b]));
      }
      system.OptimizeBroadPhase();
      return {
        step: () => engine.Step(1 / 60, 1),
        poses: () =>
          bodies.map((body) => {
            const [p, q] = [body.GetCenterOfMassPosition(), body.GetRotation()];
            return { position: [p.GetX(), p.GetY(), p.GetZ()], rotation: [q.GetX(), q.GetY(), q.GetZ(), q.GetW()] };
          }),
        settings: () => {
          const settings = system.GetPhysicsSettings();
          return { velocitySteps: settings.mNumVelocitySteps, positionSteps: settings.mNumPositionSteps };
        },
        destroy: () => api.destroy(engine),
      };
    },
  };
}
