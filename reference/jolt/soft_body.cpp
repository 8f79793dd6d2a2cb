// Jolt's calls. Why each default is changed is measured in README.md.
#include "reference/jolt/soft_body.h"

#include <Jolt/Jolt.h>  // before all others of Jolt

#include <Jolt/ConfigurationString.h>
#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/Physics/SoftBody/SoftBodyCreationSettings.h>
#include <Jolt/Physics/SoftBody/SoftBodyMotionProperties.h>
#include <Jolt/RegisterTypes.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace crosscheck::jolt {
namespace {

constexpr JPH::ObjectLayer layer = 0;
constexpr JPH::uint memory = 32 << 20;  // bytes for a step's own data; what does not fit is allocated

JPH::Vec3 to_jolt(const Triple& v) { return {float(v[0]), float(v[1]), float(v[2])}; }
template <class Vector>
Triple from_jolt(const Vector& v) {
  return {v.GetX(), v.GetY(), v.GetZ()};
}

}  // namespace

Library::Library() {
  JPH::RegisterDefaultAllocator();
  JPH::Factory::sInstance = new JPH::Factory;
  JPH::RegisterTypes();
}

Library::~Library() {
  JPH::UnregisterTypes();
  delete std::exchange(JPH::Factory::sInstance, nullptr);
}

std::string version() {
  return std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) + "." +
         std::to_string(JPH_VERSION_PATCH) + ", " + JPH::GetConfigurationString();
}

struct SoftBody::World {
  JPH::ObjectLayerPairFilterTable pairs{1};
  JPH::BroadPhaseLayerInterfaceTable layers{1, 1};
  std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> filter;
  JPH::PhysicsSystem system;
  JPH::TempAllocatorImplWithMallocFallback temporary{memory};
  JPH::JobSystemSingleThreaded jobs{JPH::cMaxPhysicsJobs};
  JPH::Body* body = nullptr;
  std::vector<JPH::Body*> balls;

  explicit World(size_t ball_count) {
    pairs.EnableCollision(layer, layer);
    layers.MapObjectToBroadPhaseLayer(layer, JPH::BroadPhaseLayer(0));
    filter = std::make_unique<JPH::ObjectVsBroadPhaseLayerFilterTable>(layers, 1, pairs, 1);
    const auto bodies = static_cast<JPH::uint>(ball_count + 1);
    system.Init(bodies, 0, bodies * bodies, bodies * bodies, layers, *filter, pairs);
  }
  ~World() {
    JPH::BodyInterface& all = system.GetBodyInterface();
    if (body) balls.push_back(body);
    for (JPH::Body* one : balls) {
      all.RemoveBody(one->GetID());
      all.DestroyBody(one->GetID());
    }
  }
  JPH::SoftBodyMotionProperties& motion() const {
    return *static_cast<JPH::SoftBodyMotionProperties*>(body->GetMotionProperties());
  }
};

SoftBody::SoftBody(const std::vector<Vertex>& vertices, const std::vector<Edge>& edges, const std::vector<Ball>& balls,
                   const Settings& settings)
    : world_(std::make_unique<World>(balls.size())) {
  JPH::BodyInterface& all = world_->system.GetBodyInterface();
  JPH::Ref<JPH::SoftBodySharedSettings> shared = new JPH::SoftBodySharedSettings;
  for (const Vertex& vertex : vertices) {
    Triple x = vertex.x;
    for (int k = 0; k < 3; ++k) x[k] -= settings.origin[k];
    JPH::SoftBodySharedSettings::Vertex made;
    to_jolt(x).StoreFloat3(&made.mPosition);
    to_jolt(vertex.v).StoreFloat3(&made.mVelocity);
    made.mInvMass = float(vertex.inverse_mass);
    shared->mVertices.push_back(made);
  }
  for (const Edge& edge : edges) {
    JPH::SoftBodySharedSettings::Edge made(edge.a, edge.b, float(edge.compliance));
    made.mRestLength = float(edge.rest);
    shared->mEdgeConstraints.push_back(made);
  }
  shared->Optimize();  // without it the first step reads out of bounds
  const JPH::RVec3 position(settings.origin[0], settings.origin[1], settings.origin[2]);
  JPH::SoftBodyCreationSettings creation(shared, position, JPH::Quat::sIdentity(), layer);
  creation.mNumIterations = static_cast<JPH::uint32>(settings.iterations);
  creation.mLinearDamping = float(settings.damping);  // default 0.1 / s
  creation.mMaxLinearVelocity = 1e15f;                // m/s, default 500: faster vertices are slowed in silence
  creation.mUpdatePosition = false;  // else the frame follows, and vertices are rounded once more in each step
  creation.mAllowSleeping = false;   // else what is slower than 0.17 m/s for half a second stops
  creation.mFriction = 1;            // of a contact: sqrt(body's times sphere's)
  creation.mRestitution = 0;         // of a contact: the larger of the two
  world_->body = all.CreateSoftBody(creation);
  if (!world_->body) throw std::runtime_error("Jolt made no soft body");
  all.AddBody(world_->body->GetID(), JPH::EActivation::Activate);

  for (const Ball& ball : balls) {
    const JPH::RVec3 centre(ball.centre[0], ball.centre[1], ball.centre[2]);
    JPH::BodyCreationSettings sphere(new JPH::SphereShape(float(ball.radius)), centre, JPH::Quat::sIdentity(),
                                     JPH::EMotionType::Static, layer);
    sphere.mFriction = float(ball.friction * ball.friction);
    sphere.mRestitution = float(ball.restitution);
    JPH::Body* made = all.CreateBody(sphere);
    if (!made) throw std::runtime_error("Jolt made no ball");
    world_->balls.push_back(made);
    all.AddBody(made->GetID(), JPH::EActivation::DontActivate);
  }
}

SoftBody::~SoftBody() = default;

void SoftBody::set_gravity(const Triple& acceleration) { world_->system.SetGravity(to_jolt(acceleration)); }

void SoftBody::step(double h) {
  const JPH::EPhysicsUpdateError error = world_->system.Update(float(h), 1, &world_->temporary, &world_->jobs);
  if (error != JPH::EPhysicsUpdateError::None) throw std::runtime_error("Jolt ran out of its buffers of contacts");
}

void SoftBody::read(double* x, double* v) const {
  const Triple origin = from_jolt(world_->body->GetCenterOfMassPosition());
  for (const auto& vertex : world_->motion().GetVertices())
    for (int k = 0; k < 3; ++k) {
      *x++ = origin[k] + double(vertex.mPosition[k]);
      *v++ = vertex.mVelocity[k];
    }
}

void SoftBody::place(int vertex, const Triple& x) {
  const Triple origin = from_jolt(world_->body->GetCenterOfMassPosition());
  world_->motion().GetVertex(vertex).mPosition = to_jolt({x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]});
}

void SoftBody::set_velocity(int vertex, const Triple& v) { world_->motion().GetVertex(vertex).mVelocity = to_jolt(v); }

Triple SoftBody::moved(int vertex) const { return from_jolt(world_->motion().GetVertex(vertex).mPosition); }

double SoftBody::inverse_mass(int vertex) const { return world_->motion().GetVertex(vertex).mInvMass; }

std::vector<Edge> SoftBody::edges_like(const std::vector<Edge>& given) const {
  std::multimap<std::pair<int, int>, Edge> found;  // parallel edges keep their order
  for (const auto& edge : world_->motion().GetSettings()->mEdgeConstraints) {
    const int a = static_cast<int>(edge.mVertex[0]), b = static_cast<int>(edge.mVertex[1]);
    found.emplace(std::pair(a, b), Edge{a, b, edge.mRestLength, edge.mCompliance});
  }
  std::vector<Edge> edges;
  for (const Edge& wanted : given) {
    const auto at = found.lower_bound({wanted.a, wanted.b});
    if (at == found.end() || at->first != std::pair(wanted.a, wanted.b))
      throw std::runtime_error("Jolt's body lacks an edge that it was given");
    edges.push_back(at->second);
    found.erase(at);
  }
  return edges;
}

Triple SoftBody::gravity() const {
  Triple g = from_jolt(world_->system.GetGravity());
  for (double& component : g) component *= world_->motion().GetGravityFactor();
  return g;
}

std::vector<Ball> SoftBody::balls() const {
  std::vector<Ball> all;
  for (const JPH::Body* ball : world_->balls) {
    const double radius = static_cast<const JPH::SphereShape*>(ball->GetShape())->GetRadius();
    all.push_back({from_jolt(ball->GetPosition()), radius + double(world_->motion().GetVertexRadius()),
                   std::sqrt(double(ball->GetFriction()) * double(world_->body->GetFriction())),
                   std::max(ball->GetRestitution(), world_->body->GetRestitution())});
  }
  return all;
}

Settings SoftBody::settings() const {
  return {from_jolt(world_->body->GetCenterOfMassPosition()), static_cast<int>(world_->motion().GetNumIterations()),
          world_->motion().GetLinearDamping()};
}

bool SoftBody::may_sleep() const { return world_->body->GetAllowSleeping(); }
double SoftBody::largest_speed() const { return world_->motion().GetMaxLinearVelocity(); }

}  // namespace crosscheck::jolt
