#include "particleSystem.h"

ParticleSystem::ParticleSystem(int numParticles) : m_numParticles(numParticles) {}
