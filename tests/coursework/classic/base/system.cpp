// The constructor that the older family's ParticleSystem declares, for submissions that left its file to the course.
// SYSTEM is the header that their own files include.
#include SYSTEM

ParticleSystem::ParticleSystem(int numParticles) : m_numParticles(numParticles) {}
