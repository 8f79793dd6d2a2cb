// MuJoCo as a program of the engine protocol.
//
// A particle is a body with three slide joints, a pin is a mocap body, a spring is a spatial tendon between two sites.
// mjcb_passive applies what tendons cannot represent: bending, wind, bullet-link springs, and springs that start at
// zero length (a tendon would pull along x); dashpots at moved pins (tendons ignore the velocity of a mocap body); and
// under RK4, springs at moved pins (a mocap body does not move during a step).
#include <mujoco/mujoco.h>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

std::string warning;  // MuJoCo's last warning, which would otherwise go to a file in the working directory
void keep_warning(const char* text) { warning = text; }
void fail(const char* text) {  // MuJoCo does not expect its error handler to return
  std::fprintf(stderr, "MuJoCo: %s\n", text);
  std::exit(1);
}
void require_no_warning() {
  if (!warning.empty()) throw std::runtime_error("MuJoCo: " + warning);
}

std::string text(const char* s) { return s; }
std::string text(const std::string& s) { return s; }
std::string text(size_t number) { return std::to_string(number); }
std::string text(double value) { return JsonWriter::of(value); }
std::string text(const Vec& v) { return text(v[0]) + " " + text(v[1]) + " " + text(v[2]); }
template <class... Parts>
std::string join(const Parts&... parts) {
  return (text(parts) + ...);
}

class MujocoWorld : public World {
 public:
  explicit MujocoWorld(const Scene& scene) : scene_(scene), called_(scene), x_(scene.x), v_(scene.v), f_(x_.size()) {
    scene.require_only({"springs", "dashpots", "bending", "constraints", "gravity", "drag", "wind", "sphere", "plane"});
    Options options(scene);
    integrator_ = options.get("integrator", {"euler", "rk4", "implicit"});
    tendons_ = options.get("springs", {"tendon", "callback"}) == "tendon" && scene.spring_law == "hooke";
    joint_drag_ = options.get("drag", {"implicit", "callback"}) == "implicit";
    options.refuse_others();
    scene.require_resting_surfaces("in contact, MuJoCo treats the velocity of a mocap body as zero");
    mju_user_error = fail, mju_user_warning = keep_warning;
    build(xml());
    if (!joint_drag_ || called_.wind || called_.springs.size() + called_.dashpots.size() + called_.bending.size() > 0)
      current_ = this, mjcb_passive = [](const mjModel*, mjData* d) { current_->add_passive(d); };
    for (size_t i = 0; i < x_.size(); ++i)
      for (int k = 0; k < 3 && !scene.pinned[i]; ++k) data_->qvel[dof(i) + k] = scene.v[i][k];
    place_pins(0);
    mj_forward(model_.get(), data_.get());
    require_no_warning();
  }

  void step(double t) override {
    data_->time = t;
    mj_step(model_.get(), data_.get());
    require_no_warning();
    place_pins(t + model_->opt.timestep);
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override {
    v = v_;  // contains the velocities of pins
    for (size_t i = 0; i < x.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (scene_.pinned[i])
          x[i][k] = data_->mocap_pos[3 * mocap(i) + k];
        else
          x[i][k] = model_->body_pos[3 * body(i) + k] + data_->qpos[dof(i) + k], v[i][k] = data_->qvel[dof(i) + k];
  }

  void report(RunReport& run) override {
    const mjModel& m = *model_;
    run.engine = join("MuJoCo ", mj_versionString());
    run.force_evaluations = (m.opt.integrator == mjINT_RK4 ? 4 : 1) * run.steps;
    Readback& r = *run.readback;
    r.drag.emplace(x_.size(), 0);
    for (size_t i = 0; i < x_.size(); ++i) {
      r.mass.push_back(m.body_mass[body(i)]);
      r.pinned.push_back(m.body_mocapid[body(i)] >= 0);
      if (!scene_.pinned[i]) (*r.drag)[i] = (joint_drag_ ? m.dof_damping[dof(i)] : scene_.drag[i]) / r.mass[i];
    }
    for (size_t i = 0; i < tendon_of_.size(); ++i) {
      const int t = tendon_of_[i];
      r.links.push_back(t < 0 ? scene_.springs[i]
                              : Spring{end(t, 0), end(t, 1), m.tendon_stiffness[t], m.tendon_lengthspring[t]});
    }
    for (int t = m.ntendon - static_cast<int>(scene_.constraints.size()); t < m.ntendon; ++t)
      r.links.push_back({end(t, 0), end(t, 1), hard, m.tendon_length0[t]});
    r.gravity = Vec{m.opt.gravity[0], m.opt.gravity[1], m.opt.gravity[2]};
    r.step = m.opt.timestep;
    r.may_sleep = false;  // this version cannot sleep
    read_surfaces(r);
    r.probe = probe();
    r.mapped = {{"springs", tendons_ ? "spatial tendons" : "mjcb_passive"},
                {"drag", joint_drag_ ? "joint damping" : "mjcb_passive"}};
    r.settings = {{"integrator", integrator_}, {"cone", "elliptic"}};
    if (!scene_.constraints.empty())
      run.different_law.push_back("constraints: soft equality of a tendon's length, not a hard distance");
    for (const char* surface : {"sphere", "plane"})
      if (scene_.term(surface))
        run.different_law.push_back(join(surface, ": soft contact; its damping ratio gives the restitution"));
  }

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  static int body(size_t i) { return static_cast<int>(i) + 1; }  // the world is body 0
  int dof(size_t i) const { return model_->body_dofadr[body(i)]; }
  int mocap(size_t i) const { return model_->body_mocapid[body(i)]; }
  int end(int tendon, int which) const { return model_->wrap_objid[model_->tendon_adr[tendon] + which]; }  // a site

  std::string xml() {
    const size_t most = x_.size() * (scene_.spheres.size() + scene_.planes.size());  // possible contacts
    double bead = 1e-3;  // m, radius of the particles' geoms; balls and planes are built smaller by this radius
    for (const Sphere& s : scene_.spheres) bead = std::min(bead, 0.5 * s.contact_radius());
    std::string xml = join("<mujoco><size nconmax='", most, "' njmax='", 3 * most + scene_.constraints.size(),
                           "'/><option cone='elliptic'/><worldbody>");
    for (size_t i = 0; i < x_.size(); ++i) {
      xml += join("<body pos='", scene_.x[i], scene_.pinned[i] ? "' mocap='true" : "", "'><site name='s", i,
                  "'/><inertial pos='0 0 0' diaginertia='1 1 1' mass='", scene_.mass[i], "'/>");
      for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"})
        if (!scene_.pinned[i]) xml += join("<joint type='slide' axis='", axis, "'/>");
      if (most > 0 && !scene_.pinned[i])
        xml += join("<geom type='sphere' solmix='0' contype='1' conaffinity='0' friction='0 0 0' size='", bead, "'/>");
      xml += "</body>";
    }
    // half an oscillation with damping ratio z leaves e = exp(-pi z / sqrt(1 - z^2)) of the speed; 1/omega is at least
    // two steps
    const auto law = [this](double friction, double e) {
      const double l = std::log(e) / pi, z = e > 0 ? -l / std::sqrt(1 + l * l) : 1;
      return join("' contype='0' conaffinity='1' friction='", friction, " 0 0' solref='",
                  std::max(0.01, 2 * scene_.step / z), " ", z, "'/>");
    };
    for (const Sphere& s : scene_.spheres)
      xml += join("<geom type='sphere' pos='", s.centre, "' size='", s.contact_radius() - bead,
                  law(s.friction, s.restitution));
    for (const Plane& p : scene_.planes)
      xml += join("<geom type='plane' size='1 1 1' pos='", p.contact_point_at(0) - bead * p.normal, "' zaxis='",
                  p.normal, law(p.friction, p.restitution));
    return xml + "</worldbody>" + tendons() + "</mujoco>";
  }

  /// Tendons of springs, then of constraints. Springs that no tendon can represent remain in called_.
  std::string tendons() {
    called_.springs.clear();
    std::string list, equality;
    const auto add = [&](const Spring& s, const std::string& name) {
      list += join("<spatial", name, "><site site='s", size_t(s.a), "'/><site site='s", size_t(s.b), "'/></spatial>");
    };
    for (const Spring& s : scene_.springs) {
      const bool tendon = tendons_ && length(scene_.x[s.a] - scene_.x[s.b]) > 0 && !(led(s) && integrator_ == "rk4") &&
                          tendon_.emplace(std::pair(s.a, s.b), tendon_.size()).second;
      tendon_of_.push_back(tendon ? static_cast<int>(tendon_.size()) - 1 : -1);
      if (tendon) add(s, "");
      if (!tendon) called_.springs.push_back(s);
    }
    for (size_t i = 0; i < scene_.constraints.size(); ++i) {
      add(scene_.constraints[i], join(" name='c", i, "'"));
      equality += join("<tendon tendon1='c", i, "' solref='", 2 * scene_.step, " 1'/>");
    }
    return join("<tendon>", list, "</tendon><equality>", equality, "</equality>");
  }

  void build(const std::string& xml) {
    const auto files = std::make_unique<mjVFS>();  // holds two megabytes of names
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[0], xml.data(), xml.size());
    char error[1000] = "";
    model_.reset(mj_loadXML("scene.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(join("MuJoCo: ", error));
    mjModel& m = *model_;
    m.opt.integrator = integrator_ == "euler" ? mjINT_EULER : integrator_ == "rk4" ? mjINT_RK4 : mjINT_IMPLICIT;
    m.opt.timestep = scene_.step;
    mju_copy3(m.opt.gravity, scene_.gravity.data());
    for (size_t i = 0; i < x_.size(); ++i)
      for (int k = 0; k < 3 && !scene_.pinned[i] && joint_drag_; ++k) m.dof_damping[dof(i) + k] = scene_.drag[i];
    for (size_t i = 0; i < tendon_of_.size(); ++i)
      if (const int t = tendon_of_[i]; t >= 0) {
        m.tendon_stiffness[t] = scene_.springs[i].stiffness;
        m.tendon_lengthspring[t] = scene_.springs[i].rest_length;
      }
    called_.dashpots.clear();
    for (const Dashpot& p : scene_.dashpots)
      if (const auto at = tendon_.find({p.a, p.b}); at != tendon_.end() && !led(p))
        m.tendon_damping[at->second] += p.coefficient;
      else
        called_.dashpots.push_back(p);
    data_.reset(mj_makeData(model_.get()));
  }

  template <class Pair>
  bool led(const Pair& p) const {  // one end is a moved pin
    return scene_.pins_move && (scene_.pinned[p.a] || scene_.pinned[p.b]);
  }

  void place_pins(double t) {
    scene_.place_pins(t, x_, v_);
    for (const int i : scene_.pins) mju_copy3(data_->mocap_pos + 3 * mocap(i), x_[i].data());
  }

  void add_passive(mjData* d) {
    for (size_t i = 0; i < f_.size(); ++i)
      for (int k = 0; k < 3 && !scene_.pinned[i]; ++k)
        x_[i][k] = d->xpos[3 * body(i) + k], v_[i][k] = d->qvel[dof(i) + k];
    scene_.place_pins(d->time, x_, v_);
    set_forces(called_, x_, v_, d->time, f_);
    for (size_t i = 0; i < f_.size(); ++i)
      for (int k = 0; k < 3 && !scene_.pinned[i]; ++k)
        d->qfrc_passive[dof(i) + k] += f_[i][k] - (joint_drag_ ? 0 : scene_.drag[i] * v_[i][k]);
  }

  /// Reads balls and planes from the model's first geoms, which precede those of particles.
  void read_surfaces(Readback& r) const {
    const mjModel& m = *model_;
    r.spheres.emplace(), r.planes.emplace();
    for (int g = 0; g < m.ngeom && m.geom_bodyid[g] == 0; ++g) {
      const mjtNum *at = data_->geom_xpos + 3 * g, *axes = data_->geom_xmat + 9 * g;
      const double bead = m.geom_size[3 * (m.ngeom - 1)], z = m.geom_solref[mjNREF * g + 1],
                   mu = m.geom_friction[3 * g];
      const double e = z < 1 ? std::exp(-pi * z / std::sqrt(1 - z * z)) : 0;
      const Vec centre{at[0], at[1], at[2]}, normal{axes[2], axes[5], axes[8]};
      if (m.geom_type[g] == mjGEOM_SPHERE)
        r.spheres->push_back({centre, m.geom_size[3 * g] + bead, mu, e});
      else
        r.planes->push_back({centre + bead * normal, normal, mu, e});
      if (r.later && m.geom_type[g] == mjGEOM_SPHERE) r.later->centres.push_back(centre);
      if (r.later && m.geom_type[g] == mjGEOM_PLANE) r.later->points.push_back(centre + bead * normal);
    }
    if (!r.spheres->empty()) r.margin = r.spheres->front().radius - scene_.spheres.front().radius;
  }

  /// Probes the forces of the tendons (first with damping only, then with stiffness only) and of the callback's terms.
  Probe probe() {
    Probe p = probe_of_forces(called_, probe_state(scene_));
    mjModel& m = *model_;
    mjData& d = *data_;
    for (size_t i = 0; i < p.x.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (scene_.pinned[i])
          d.mocap_pos[3 * mocap(i) + k] = p.x[i][k];
        else
          d.qpos[dof(i) + k] = p.x[i][k] - m.body_pos[3 * body(i) + k], d.qvel[dof(i) + k] = p.v[i][k];
    mj_fwdPosition(&m, &d);
    mjcb_passive = nullptr;
    mju_zero(m.dof_damping, m.nv);
    const auto add_to = [&](std::vector<Vec>& f) {
      mj_fwdVelocity(&m, &d);
      for (size_t i = 0; i < f.size(); ++i)
        for (int k = 0; k < 3 && !scene_.pinned[i]; ++k) f[i][k] += d.qfrc_passive[dof(i) + k];
    };
    const std::vector<mjtNum> stiffness(m.tendon_stiffness, m.tendon_stiffness + m.ntendon);
    mju_zero(m.tendon_stiffness, m.ntendon);
    add_to(p.dashpots);
    mju_copy(m.tendon_stiffness, stiffness.data(), m.ntendon);
    mju_zero(m.tendon_damping, m.ntendon);
    add_to(p.springs);
    return p;
  }

  static inline MujocoWorld* current_ = nullptr;  // MuJoCo's callbacks have no user pointer
  const Scene& scene_;
  Scene called_;  // contains only the springs and dashpots that the callback applies
  std::string integrator_;
  bool tendons_ = true, joint_drag_ = true;
  std::vector<int> tendon_of_;                    // tendon of each spring; -1: applied by the callback
  std::map<std::pair<int, int>, size_t> tendon_;  // by pair of particles
  std::vector<Vec> x_, v_, f_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

}  // namespace

int main(int argc, char** argv) { return run_program<MujocoWorld>(argc, argv); }
