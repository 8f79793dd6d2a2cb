// The renderer: shadow maps, then the panel, once (fast) or for every light sample, summed and divided at the end
// (still).
//
// Accumulation (Haeberli and Akeley 1990): each pass shifts the camera within the pixel and takes one point of the key
// light and one of the sky, each with a shadow map of its own. The mean of the passes has smooth edges, soft shadows
// and the darkness of covered places at once, and the same samples serve all pixels, so there is no grain.
#include "report/pictures/painter.h"

#include <Eigen/Geometry>

#include "report/pictures/camera.h"
#include "report/pictures/gl.h"
#include "report/pictures/mesh.h"

namespace crosscheck::render {
namespace {

constexpr int still_passes = 48;
constexpr unsigned plain_cloth = 0xEBDDC6;

/// All of a panel's shapes uploaded: full detail for the eye, less for the shadows.
struct Uploaded {
  Batch cloth, balls, beads, rods, trail, balls_shadow, beads_shadow, rods_shadow;
  Uploaded(const Gl& gl, const DrawList& s, bool many)
      : cloth(gl, s.cloth, s.cloth_index),
        balls(gl, sphere_mesh(112), s.balls),
        beads(gl, sphere_mesh(many ? 24 : 48), s.beads),
        rods(gl, many ? capsule_mesh(8, 1) : capsule_mesh(20, 5), s.rods),
        trail(gl, capsule_mesh(8, 2), s.trail),
        balls_shadow(gl, sphere_mesh(64), s.balls),
        beads_shadow(gl, sphere_mesh(16), s.beads),
        rods_shadow(gl, capsule_mesh(many ? 5 : 12, many ? 1 : 2), s.rods) {}
};

/// Clip space to the 0..1 of a texture and its depth.
Eigen::Matrix4f to_texture(const Eigen::Matrix4f& to_clip) {
  Eigen::Matrix4f half = Eigen::Matrix4f::Identity() * 0.5f;
  half.col(3) << 0.5f, 0.5f, 0.5f, 1;
  return half * to_clip;
}

std::string with(const char* material, Quality quality) {
  return quality == Quality::fast ? std::string(material) + " FAST" : std::string(material);
}

}  // namespace

struct Painter::Parts {
  const Gl& gl;
  const int width, height;
  const Quality quality;
  const Program cloth, cloth_values, sphere, rod, trail, ground, sum;
  const Program cloth_shadow, sphere_shadow, rod_shadow;
  const ShadowMap key_map, sky_map;
  const ColourTarget pass, total;
  const std::unique_ptr<SampledTarget> sampled;
  GLuint scale_map = 0, nothing = 0;

  Parts(const Gl& gl_, int width_, int height_, Quality quality_, bool diverging)
      : gl(gl_),
        width(width_),
        height(height_),
        quality(quality_),
        cloth(gl, with("CLOTH", quality)),
        cloth_values(gl, with("CLOTH VALUES", quality)),
        sphere(gl, with("SPHERE", quality)),
        rod(gl, with("ROD", quality)),
        trail(gl, with("TRAIL", quality)),
        ground(gl, with("GROUND", quality)),
        sum(gl, "SUM"),
        cloth_shadow(gl, "CLOTH SHADOW"),
        sphere_shadow(gl, "SPHERE SHADOW"),
        rod_shadow(gl, "ROD SHADOW"),
        key_map(gl, quality == Quality::fast ? 768 : 512),
        sky_map(gl, quality == Quality::fast ? 128 : 256),
        pass(gl, width, height, GL_RGBA16F, true),
        total(gl, width, height, GL_RGBA32F, false),
        sampled(quality == Quality::fast ? std::make_unique<SampledTarget>(gl, width, height, GL_RGBA16F) : nullptr) {
    std::vector<float> map;
    for (int i = 0; i < 256; ++i) {
      const Colour c = to_linear(scale_colour(diverging, float(i) / 255));
      map.insert(map.end(), {c.x(), c.y(), c.z()});
    }
    gl.GenTextures(1, &scale_map);
    gl.BindTexture(GL_TEXTURE_2D, scale_map);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, 256, 1, 0, GL_RGB, GL_FLOAT, map.data());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.GenVertexArrays(1, &nothing);
    gl.ActiveTexture(GL_TEXTURE0), gl.BindTexture(GL_TEXTURE_2D, key_map.texture);
    gl.ActiveTexture(GL_TEXTURE1), gl.BindTexture(GL_TEXTURE_2D, sky_map.texture);
    gl.ActiveTexture(GL_TEXTURE2), gl.BindTexture(GL_TEXTURE_2D, scale_map);
    gl.ActiveTexture(GL_TEXTURE3), gl.BindTexture(GL_TEXTURE_2D, pass.texture);
  }

  void draw_shadow(const ShadowMap& map, const Eigen::Matrix4f& to_clip, const Uploaded& shapes) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
    gl.Viewport(0, 0, map.size, map.size);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_DEPTH_CLAMP);
    const auto cast = [&](const Program& program, std::initializer_list<const Batch*> batches) {
      program.use();
      program.set("to_clip", to_clip);
      for (const Batch* batch : batches) batch->draw();
    };
    cast(cloth_shadow, {&shapes.cloth});
    cast(sphere_shadow, {&shapes.balls_shadow, &shapes.beads_shadow});
    cast(rod_shadow, {&shapes.rods_shadow});
    gl.Disable(GL_DEPTH_CLAMP);
  }

  void draw_panel(const DrawList& list, const Frame& frame, const Sample& sample, float open_ground,
                  const Uploaded& shapes) const {
    const Eigen::Matrix4f key = light_matrix(sample.key, list.centre, list.radius);
    const Eigen::Matrix4f sky = light_matrix(sample.sky, list.centre, list.radius);
    draw_shadow(key_map, key, shapes);
    draw_shadow(sky_map, sky, shapes);

    gl.BindFramebuffer(GL_FRAMEBUFFER, sampled ? sampled->framebuffer : pass.framebuffer);
    gl.Viewport(0, 0, width, height);
    const Colour background = linear(background_hex);
    gl.ClearColor(background.x(), background.y(), background.z(), 1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    Eigen::Matrix4f shift = Eigen::Matrix4f::Identity();
    shift(0, 3) = 2 * sample.pixel.x() / float(width), shift(1, 3) = 2 * sample.pixel.y() / float(height);

    const auto begin = [&](const Program& program) {
      program.use();
      program.set("to_clip", Eigen::Matrix4f(shift * frame.to_clip));
      program.set("to_key", to_texture(key)), program.set("to_sky", to_texture(sky));
      program.set("key_map", 0), program.set("sky_map", 1), program.set("scale_map", 2);
      program.set("key_texel", 2 * list.radius / float(key_map.size));
      program.set("sky_texel", 2 * list.radius / float(sky_map.size));
      program.set("key", sample.key), program.set("sky", sample.sky), program.set("eye", frame.eye);
      program.set("lift", list.lift);
    };
    if (!shapes.cloth.empty()) {
      const Program& program = list.coloured ? cloth_values : cloth;
      begin(program);
      program.set("plain", linear(plain_cloth)), program.set("no_value", linear(no_value_hex));
      shapes.cloth.draw();
    }
    gl.Enable(GL_CULL_FACE);
    begin(sphere), shapes.balls.draw(), shapes.beads.draw();
    begin(rod), shapes.rods.draw();
    if (frame.floor && frame.eye.y() > *frame.floor) {
      begin(ground);
      ground.set("background", background), ground.set("unoccluded", open_ground);
      ground.set("ground", Eigen::Vector4f(list.centre.x(), *frame.floor, list.centre.z(), 3.0f * list.radius));
      ground.set("panel", Eigen::Vector3f(float(width), float(height), 0));
      gl.BindVertexArray(nothing);
      gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    // last and without depth of its own: where the trail crosses itself, the newer part covers the older
    gl.DepthMask(GL_FALSE);
    begin(trail), shapes.trail.draw();
    gl.DepthMask(GL_TRUE);
  }

  void add_pass_to_total() const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, total.framebuffer);
    gl.Disable(GL_DEPTH_TEST), gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    sum.use();
    sum.set("pass", 3);
    gl.BindVertexArray(nothing);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
  }

  std::vector<float> read(GLuint framebuffer) const {
    std::vector<float> pixels(4 * std::size_t(width) * std::size_t(height));
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    return pixels;
  }
};

Painter::Painter(const Gl& gl, int width, int height, Quality quality, bool diverging)
    : parts_(std::make_unique<Parts>(gl, width, height, quality, diverging)) {}

Painter::~Painter() = default;

std::vector<float> Painter::paint(const DrawList& list, const Frame& frame) {
  const Parts& p = *parts_;
  const Uploaded shapes(p.gl, list, list.rods.size() > 250);
  p.gl.Enable(GL_DEPTH_TEST);
  if (p.quality == Quality::fast) {
    const Sample sample{Eigen::Vector2f::Zero(), key_direction(), Eigen::Vector3f::UnitY()};
    p.draw_panel(list, frame, sample, key_light * sample.key.y() + sky_light, shapes);
    p.gl.BindFramebuffer(GL_READ_FRAMEBUFFER, p.sampled->framebuffer);
    p.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, p.pass.framebuffer);
    p.gl.BlitFramebuffer(0, 0, p.width, p.height, 0, 0, p.width, p.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return p.read(p.pass.framebuffer);
  }

  const std::vector<Sample> samples = light_samples(still_passes);
  float open_ground = 0;
  for (const Sample& s : samples) open_ground += (key_light * s.key.y() + sky_light * 2 * s.sky.y()) / still_passes;
  p.gl.BindFramebuffer(GL_FRAMEBUFFER, p.total.framebuffer);
  p.gl.ClearColor(0, 0, 0, 0);
  p.gl.Clear(GL_COLOR_BUFFER_BIT);
  for (const Sample& s : samples) {
    p.draw_panel(list, frame, s, open_ground, shapes);
    p.add_pass_to_total();
  }
  std::vector<float> pixels = p.read(p.total.framebuffer);
  for (float& x : pixels) x /= still_passes;
  return pixels;
}

}  // namespace crosscheck::render
