#include "ParticleSystem.h"

class SimpleSystem : public ParticleSystem
{
public:
    vector<Vector3f> evalF(const vector<Vector3f>& state) const
    {
        cout << "simple: " << state.size() << endl;
        return vector<Vector3f>(1, Vector3f(-state[0].y(), state[0].x(), 0));
    }
    void initState() { state.assign(1, Vector3f(1, 0, 0)); }
    void draw() const;
};
