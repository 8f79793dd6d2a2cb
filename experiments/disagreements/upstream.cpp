// The gallery of upstream troubles, and reports of two of them that can be sent as they are.
#include "experiments/disagreements/upstream.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/disagreements/disagreements.h"
#include "experiments/tables/disagreements.h"

namespace crosscheck {
namespace {

/// Open threads that no scene of particles and springs asks.
struct UnaskedThread {
  std::string_view thread, what, why;
};
constexpr UnaskedThread unasked[] = {
    {"bullet3#4675", "soft-body collisions are not thread safe", "worlds are run on one thread here"},
    {"bullet3#4070", "an anchored soft cube is unstable", "scenes have pins, no anchors on rigid bodies"},
    {"bullet3#4687, bullet3#4667", "anchors on static or sleeping bodies explode",
     "scenes have pins, no anchors on rigid bodies"},
    {"bullet3#3005", "cloth penetrates itself", "scenes have no self-collision"},
    {"bullet3#3210", "a soft ball is crushed on the ground", "a neo-Hookean solid: scenes have springs only"},
    {"bullet3#2269", "SIGSEGV in btSparseSdf::Evaluate when a body tears", "scenes have springs that do not tear"},
    {"bullet3#845", "generateBendingConstraints is slow", "links are built from the scene, not generated"},
};

/// Of a program the row's world names it; of the installed Bullet the tables' line of engines does.
std::string version_of(const DisagreementRow& row, const std::string& engines) {
  if (row.world.starts_with(program_prefix)) return row.world;
  const size_t bullet = engines.find("Bullet");  // behind what else was run
  return fmt::format("{}, {}", bullet == std::string::npos ? engines : engines.substr(bullet), row.world);
}

std::string gallery(const std::vector<DisagreementRow>& rows, const std::string& engines) {
  std::string text =
      "# Troubles of Bullet's soft bodies, each in the smallest scene that shows it\n\n"
      "*Explained*: the symptom is there, and without its cause it is not. *Reproduced*: the symptom is there. *Not "
      "reproduced*: the world does what is asked. *Not asked*: it cannot be run. Each is computed from the runs by the "
      "criterion that stands with it.\n";
  for (const DisagreementRow& row : rows)
    text +=
        fmt::format("\n## {}\n\n**{}** · scene `{}` · {}\n\nUpstream: {}.\n\n{}\n\nMeasured: {}\n\nCriterion: {}.\n",
                    row.what, row.state, row.name, version_of(row, engines),
                    row.threads.empty() ? "no report known" : row.threads, row.cause, row.effect, row.criterion);
  text += "\n## Threads that no scene asks\n\n| thread | trouble | why not |\n|---|---|---|\n";
  for (const UnaskedThread& u : unasked) text += fmt::format("| {} | {} | {} |\n", u.thread, u.what, u.why);
  return text;
}

// The programs and what they print were run with Bullet 3.24 in double precision (Debian 3.24+dfsg-2), the change of
// buildTreeBottomUp with btSoftBody.cpp of tag 3.24.

constexpr std::string_view pieces_report = R"(# A soft body in several pieces hangs: buildTreeBottomUp never ends

Version: {version}.

## What happens

`btSoftBody::initializeFaceTree()` does not return when the links of the body do not join all of its nodes (or its faces are not all joined by edges). It is called

- by `btSoftBody::predictMotion()` where the collision flags have `VF_SS` (position-based world),
- by `btDeformableBodySolver::predictDeformableMotion()` where they have `SDF_RD` (deformable world),
- by `btSoftBody::rayTest()` on a body with faces whose tree is not built yet.

In all three ways the first call hangs (Bullet 3.24) with two separate triangles, and returns when they are joined.

## Program

```cpp
{program}```

Expected: two lines. Found with Bullet 3.24 (double precision, Debian 3.24+dfsg-2): the first line, then a busy core until it was killed. With any argument, which joins the two pieces, it prints both. Backtrace:

```
#0  ?? () in libBulletSoftBody-float64.so.3.24 (static: buildTreeBottomUp)
#1  btSoftBody::rebuildNodeTree()
#2  btSoftBody::initializeFaceTree()
#3  main
```

## In a scene

{effect}

## Cause

`buildTreeBottomUp` (btSoftBody.cpp) runs `while (N > 1)`. In each pass a node is merged with a neighbour in `adj` that is not yet marked. When every piece has become one node, no node has a neighbour: a pass copies all nodes, `N` stays, and the loop goes on for ever.

## Suggested change

When no node has a neighbour left, let each be a neighbour of the next one; after `marked` is cleared:

```cpp
bool anyEdge = false;
for (int i = 0; i < N && !anyEdge; ++i)
	anyEdge = adj[i].size() > 0;
for (int i = 0; i + 1 < N && !anyEdge; ++i)
{
	adj[i].push_back(i + 1);
	adj[i + 1].push_back(i);
}
```

With this change of tag 3.24 the program above, both worlds' first step and the ray test return.

Probably the same: {threads} (by their descriptions; the stack in Minie#35 is that of the first way).
)";

constexpr std::string_view pieces_program = R"(#include <BulletSoftBody/btSoftBody.h>
#include <cstdio>

int main(int argc, char**) {
  btSoftBodyWorldInfo info;
  const btVector3 x[4] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
  const btScalar m[4] = {1, 1, 1, 1};
  btSoftBody body(&info, 4, x, m);
  body.appendLink(0, 1);
  body.appendLink(2, 3);
  if (argc > 1) body.appendLink(1, 2);  // any argument joins the pieces
  std::puts("calling initializeFaceTree");
  std::fflush(stdout);
  body.initializeFaceTree();
  std::puts("returned");
}
)";

constexpr std::string_view direction_report =
    R"(# The normal of soft-body contacts is piecewise constant: btSparseSdf::Evaluate

Version: {version}.

## What happens

Nodes that touch a smooth body are pushed in a direction that is off its normal, by an angle that depends on where in a voxel of the distance field they are, and not on the time step: a ball acts like one with facets.

## Program

```cpp
{program}```

Expected: the normal of the ball, nearly. Found with Bullet 3.24 (double precision, Debian 3.24+dfsg-2), on voxels of size a:

```
voxel 0.02 m: Evaluate 13.9 mrad off, central differences 0.0461 mrad
voxel 0.005 m: Evaluate 3.46 mrad off, central differences 0.00288 mrad
voxel 0.00125 m: Evaluate 0.863 mrad off, central differences 0.000186 mrad
```

## In a scene

A particle is let go at rest on a ball of 1 m without friction. {effect}

## Cause

`Evaluate` takes `normal` as the gradient of the trilinear interpolation inside one voxel. Along each axis that is one difference over the whole voxel: right in its middle, and off by a / 2R at its faces, on each axis, where it jumps to the next voxel's. The distance itself is right to second order; its derivative is right to first order only.

## Suggested change

Take the normal from central differences of the interpolated distance over one voxel, (d(x + a/2 e) - d(x - a/2 e)) for each axis e: continuous, and right to second order. The program above prints what it gives on the same field: at least 300 times nearer. It costs six evaluations of the distance for a contact that was found.

Upstream reports of this: none known.
)";

constexpr std::string_view direction_program = R"(#include <BulletSoftBody/btSparseSDF.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
  const btScalar R = 1, margin = btScalar(0.02);
  btSphereShape ball(R);
  for (const btScalar a : {0.02, 0.005, 0.00125}) {
    btSparseSdf<3> field;
    field.Initialize(2383, 1 << 20);
    field.setDefaultVoxelsz(a);
    field.Reset();
    double worst = 0, worst_central = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double angle = (2 + 43. * i / 4000) * M_PI / 180;  // from the top
      const btVector3 n(std::sin(angle), std::cos(angle), 0), x = n * (R + margin);
      btVector3 found, central, unused;
      field.Evaluate(x, &ball, found, 0);
      for (int k = 0; k < 3; ++k) {
        btVector3 e(0, 0, 0);
        e[k] = a / 2;
        central[k] = field.Evaluate(x + e, &ball, unused, 0) - field.Evaluate(x - e, &ball, unused, 0);
      }
      worst = std::max(worst, double((found - n).length()));
      worst_central = std::max(worst_central, double((central.normalized() - n).length()));
    }
    std::printf("voxel %g m: Evaluate %.3g mrad off, central differences %.3g mrad\n", double(a), 1e3 * worst,
                1e3 * worst_central);
    field.Reset();
  }
}
)";

struct Report {
  std::string_view name, text, program;
};
constexpr Report reports[] = {{"network-in-pieces", pieces_report, pieces_program},
                              {"contact-direction", direction_report, direction_program}};

std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [key, value] : values)
    if (const size_t at = text.find(key); at != std::string::npos) text.replace(at, key.size(), value);
  return text;
}

bool is_there(const DisagreementRow& row) {
  return row.state == name_of(TroubleState::explained) || row.state == name_of(TroubleState::reproduced);
}

}  // namespace

std::vector<UpstreamText> upstream_texts(const TableSet& rows, const std::string& engines) {
  const Table* table = rows.table(std::string(DisagreementRow::table));
  if (!table || table->rows.empty()) return {};
  const std::vector<DisagreementRow> all = rows_of<DisagreementRow>(*table);
  std::vector<UpstreamText> texts{{"upstream-gallery.md", gallery(all, engines)}};
  for (const DisagreementRow& row : all)
    if (const auto report = std::ranges::find(reports, row.name, &Report::name);
        report != std::end(reports) && is_there(row))
      texts.push_back({fmt::format("upstream-{}.md", row.name),
                       filled(std::string(report->text), {{"{version}", version_of(row, engines)},
                                                          {"{program}", std::string(report->program)},
                                                          {"{effect}", row.effect},
                                                          {"{threads}", row.threads}})});
  return texts;
}

}  // namespace crosscheck
