#ifndef PARTICLE_SYSTEM
#define PARTICLE_SYSTEM
#include <vecmath.h>
using namespace std;

// All members are const except those that change the state.
class ParticleSystem
{
public:
    ParticleSystem() {}
    virtual ~ParticleSystem() {}
    virtual vector<Vector3f> evalF(const vector<Vector3f>& state) const = 0;
    virtual void initState() = 0;
    virtual void draw() const = 0;
    const vector<Vector3f>& getState() const { return state; }
    void setState(const vector<Vector3f>& s) { state = s; }
protected:
    vector<Vector3f> state;
};
#endif
