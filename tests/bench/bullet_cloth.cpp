#include "bullet_cloth.hpp"

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>

namespace bench {
namespace {

const btVector3 kGravity(0, btScalar(-9.81), 0);

} // namespace

struct BulletCloth::Parts
{
    btSoftBodyRigidBodyCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::unique_ptr<btSoftBody> body;
    btScalar timestep = 0;

    ~Parts() { world.removeSoftBody(body.get()); }
};

BulletCloth::BulletCloth(const BulletSheet& sheet) : parts_(std::make_unique<Parts>())
{
    const std::size_t count = sheet.places.size() / 3;
    std::vector<btVector3> places;
    for (std::size_t v = 0; v < count; ++v)
        places.emplace_back(static_cast<btScalar>(sheet.places[3 * v]),
                            static_cast<btScalar>(sheet.places[3 * v + 1]),
                            static_cast<btScalar>(sheet.places[3 * v + 2]));
    const std::vector<btScalar> masses(count, btScalar(1));
    parts_->world.setGravity(kGravity);
    btSoftBodyWorldInfo& info = parts_->world.getWorldInfo();
    info.m_gravity = kGravity;
    info.air_density = 0;
    info.m_broadphase = &parts_->broadphase;
    info.m_dispatcher = &parts_->dispatcher;
    parts_->body = std::make_unique<btSoftBody>(&info, static_cast<int>(count), places.data(), masses.data());
    btSoftBody& body = *parts_->body;
    for (const auto& [a, b] : sheet.links)
        body.appendLink(static_cast<int>(a), static_cast<int>(b));
    for (const std::uint32_t v : sheet.pins)
        body.setMass(static_cast<int>(v), 0);
    body.m_materials[0]->m_kLST = 1;
    body.m_cfg.piterations = sheet.iterations;
    body.m_cfg.collisions = 0;
    body.m_cfg.kDP = static_cast<btScalar>(1 - std::exp(-sheet.damping * sheet.timestep));
    parts_->timestep = static_cast<btScalar>(sheet.timestep);
    parts_->world.addSoftBody(&body, 0, 0); // of no group: nothing is near it
}

BulletCloth::~BulletCloth() = default;

void BulletCloth::step() { parts_->world.stepSimulation(parts_->timestep, 0); }

std::vector<double> BulletCloth::places() const
{
    std::vector<double> out;
    for (int v = 0; v < parts_->body->m_nodes.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            out.push_back(static_cast<double>(parts_->body->m_nodes[v].m_x[axis]));
    return out;
}

int BulletCloth::version() { return btGetVersion(); }

} // namespace bench
