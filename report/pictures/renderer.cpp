// Renders panels without text. Accumulates passes (Haeberli and Akeley 1990): each pass shifts the camera within the
// pixel, and draws two shadow maps, one for a point of the key light and one for a point of the sky. The mean of the
// passes has smooth edges, soft shadows and ambient occlusion. All pixels use the same samples, so there is no grain.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "report/pictures/draw_list.h"
#include "report/pictures/gl.h"
#include "report/pictures/layout.h"

namespace crosscheck::render {
namespace {

constexpr int still_passes = 48, fast_passes = 8;
constexpr int key_texels = 512, sky_texels = 256;
constexpr unsigned plain_cloth = 0xEBDDC6;

using Columns = std::vector<VertexRows::Column>;

template <class T>
VertexRows rows_of(const std::vector<T>& of, const Columns& columns) {
  return {of.data(), of.size(), sizeof(T), columns};
}

Batch batch_of(const RodMesh& mesh, const std::vector<Rod>& rods) {
  return {mesh.index, rows_of(mesh.corner, {{0, 4, 0}}),
          rows_of(rods, {{1, 4, offsetof(Rod, a)}, {2, 3, offsetof(Rod, b)}, {3, 3, offsetof(Rod, colour)}})};
}

/// Shapes of a panel: detailed ones for the eye, and coarser ones for shadows and for large numbers of shapes.
struct Uploaded {
  Batch cloth, balls, beads, rods, trail, beads_shadow, rods_shadow;
  Uploaded(const DrawList& s, bool many)
      : cloth(s.cloth_index, rows_of(s.cloth, {{0, 3, offsetof(ClothVertex, x)},
                                               {1, 3, offsetof(ClothVertex, normal)},
                                               {2, 3, offsetof(ClothVertex, rim)},
                                               {3, 1, offsetof(ClothVertex, value)}})),
        balls(batch_of(rod_mesh(112, 28), s.balls)),
        beads(batch_of(many ? rod_mesh(24, 6) : rod_mesh(48, 12), s.beads)),
        rods(batch_of(many ? rod_mesh(8, 1) : rod_mesh(20, 5), s.rods)),
        trail(batch_of(rod_mesh(8, 2), s.trail)),
        beads_shadow(batch_of(rod_mesh(16, 4), s.beads)),
        rods_shadow(batch_of(many ? rod_mesh(5, 1) : rod_mesh(12, 2), s.rods)) {}
};

/// Maps clip space to 0..1 in a texture and its depth.
Eigen::Matrix4f to_texture(const Eigen::Matrix4f& to_clip) {
  Eigen::Matrix4f half = Eigen::Matrix4f::Identity() * 0.5f;
  half.col(3) << 0.5f, 0.5f, 0.5f, 1;
  return half * to_clip;
}

/// Draws panels of one size and quality while the context exists.
struct Painter {
  const int width, height;
  const std::vector<Sample> samples;
  const std::vector<unsigned char> srgb = srgb_table();
  const Program cloth{"CLOTH"}, cloth_values{"CLOTH VALUES"}, rod{"ROD"}, trail{"TRAIL"}, ground{"GROUND"}, sum{"SUM"};
  const Program cloth_shadow{"CLOTH SHADOW"}, rod_shadow{"ROD SHADOW"};
  const Target key_map = shadow_map(key_texels), sky_map = shadow_map(sky_texels);
  const Target pass, total;
  GLuint scale_map = 0, nothing = 0;
  float open_ground = 0;  // mean light on the ground without shadows

  Painter(int width_, int height_, Quality quality)
      : width(width_),
        height(height_),
        samples(light_samples(quality == Quality::fast ? fast_passes : still_passes)),
        pass(colour_target(width, height, GL_RGBA16F, true)),
        total(colour_target(width, height, GL_RGBA32F, false)) {
    for (const Sample& s : samples) open_ground += key_light * s.key.y() + sky_light * 2 * s.sky.y();
    open_ground /= float(samples.size());
    std::vector<float> map;
    for (int i = 0; i < 256; ++i) {
      const Colour c = to_linear(scale_colour(float(i) / 255));
      map.insert(map.end(), {c.x(), c.y(), c.z()});
    }
    glGenTextures(1, &scale_map);
    glBindTexture(GL_TEXTURE_2D, scale_map);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, 256, 1, 0, GL_RGB, GL_FLOAT, map.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glGenVertexArrays(1, &nothing);
    const GLuint textures[] = {key_map.texture, sky_map.texture, scale_map, pass.texture};
    for (GLuint i = 0; i < 4; ++i) glActiveTexture(GL_TEXTURE0 + i), glBindTexture(GL_TEXTURE_2D, textures[i]);
  }

  void draw_shadow(const Target& map, int texels, const Eigen::Matrix4f& to_clip, const Uploaded& shapes) const {
    glBindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
    glViewport(0, 0, texels, texels);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP);
    const auto cast = [&](const Program& program, std::initializer_list<const Batch*> batches) {
      program.use();
      program.set("to_clip", to_clip);
      for (const Batch* batch : batches) batch->draw();
    };
    cast(cloth_shadow, {&shapes.cloth});
    cast(rod_shadow, {&shapes.balls, &shapes.beads_shadow, &shapes.rods_shadow});
    glDisable(GL_DEPTH_CLAMP);
  }

  void draw_panel(const DrawList& list, const Frame& frame, const Sample& sample, const Uploaded& shapes) const {
    const Eigen::Matrix4f key = light_matrix(sample.key, list.centre, list.radius);
    const Eigen::Matrix4f sky = light_matrix(sample.sky, list.centre, list.radius);
    draw_shadow(key_map, key_texels, key, shapes);
    draw_shadow(sky_map, sky_texels, sky, shapes);

    glBindFramebuffer(GL_FRAMEBUFFER, pass.framebuffer);
    glViewport(0, 0, width, height);
    const Colour background = linear(background_hex);
    glClearColor(background.x(), background.y(), background.z(), 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    Eigen::Matrix4f shift = Eigen::Matrix4f::Identity();
    shift(0, 3) = 2 * sample.pixel.x() / float(width), shift(1, 3) = 2 * sample.pixel.y() / float(height);

    const auto begin = [&](const Program& program) {
      program.use();
      program.set("to_clip", Eigen::Matrix4f(shift * frame.to_clip));
      program.set("to_key", to_texture(key)), program.set("to_sky", to_texture(sky));
      program.set("key_map", 0), program.set("sky_map", 1), program.set("scale_map", 2);
      program.set("key_texel", 2 * list.radius / float(key_texels));
      program.set("sky_texel", 2 * list.radius / float(sky_texels));
      program.set("key", sample.key), program.set("sky", sample.sky), program.set("eye", frame.eye);
      program.set("lift", list.lift);
    };
    if (!shapes.cloth.empty()) {
      const Program& program = list.coloured ? cloth_values : cloth;
      begin(program);
      program.set("plain", linear(plain_cloth));
      shapes.cloth.draw();
    }
    glEnable(GL_CULL_FACE);
    begin(rod), shapes.balls.draw(), shapes.beads.draw(), shapes.rods.draw();
    if (frame.floor && frame.eye.y() > *frame.floor) {
      begin(ground);
      ground.set("background", background), ground.set("unoccluded", open_ground);
      ground.set("blur", std::sqrt(float(still_passes) / float(samples.size())));
      ground.set("ground", Eigen::Vector4f(list.centre.x(), *frame.floor, list.centre.z(), 3.0f * list.radius));
      ground.set("panel", Eigen::Vector3f(float(width), float(height), 0));
      glBindVertexArray(nothing);
      glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    // draw the trail last, and without writing depth, so that its newer part is on top where the trail crosses itself
    glDepthMask(GL_FALSE);
    begin(trail), shapes.trail.draw();
    glDepthMask(GL_TRUE);
  }

  void add_pass_to_total() const {
    glBindFramebuffer(GL_FRAMEBUFFER, total.framebuffer);
    glDisable(GL_DEPTH_TEST), glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    sum.use();
    sum.set("pass", 3);
    glBindVertexArray(nothing);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
  }

  /// Linear light, 4 floats per pixel (the last is unused), rows from bottom to top.
  std::vector<float> paint(const DrawList& list, const Frame& frame) const {
    const Uploaded shapes(list, list.rods.size() > 250);
    glEnable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, total.framebuffer);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    for (const Sample& sample : samples) {
      draw_panel(list, frame, sample, shapes);
      add_pass_to_total();
    }
    std::vector<float> pixels(4 * std::size_t(width) * std::size_t(height));
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    for (float& x : pixels) x /= float(samples.size());
    return pixels;
  }
};

/// Copies linear pixels (rows from the bottom) into the image (rows from the top).
void put(const std::vector<float>& pixels, const std::vector<unsigned char>& srgb, const Layout& layout, int left,
         int top, Image& image) {
  for (int y = 0; y < layout.panel_height; ++y) {
    const float* from = &pixels[4 * std::size_t(layout.panel_height - 1 - y) * std::size_t(layout.panel_width)];
    unsigned char* to = &image.rgb[3 * (std::size_t(top + y) * std::size_t(image.width) + std::size_t(left))];
    for (int x = 0; x < layout.panel_width; ++x) {
      for (int channel = 0; channel < 3; ++channel)
        to[3 * x + channel] = srgb[std::size_t(std::fmin(std::fmax(from[4 * x + channel], 0.f), 1.f) * 16384 + 0.5f)];
    }
  }
}

Image blank(int width, int height) {
  Image image{width, height, std::vector<unsigned char>(3 * std::size_t(width) * std::size_t(height))};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = (background_hex >> (16 - 8 * (i % 3))) & 255;
  return image;
}

}  // namespace

Image draw(const Picture& picture) {
  const Layout layout = layout_of(picture);
  const Frame frame = frame_of(picture.view, double(layout.panel_width) / layout.panel_height);
  Image image = blank(picture.width, picture.height);
  const Context context;  // its destructor, which runs last, deletes all textures and programs
  const Painter painter(layout.panel_width, layout.panel_height, picture.quality);
  for (std::size_t row = 0; row < picture.rows.size(); ++row)
    for (std::size_t column = 0; column < picture.rows[row].size(); ++column) {
      const DrawList list = draw_list_of(picture.rows[row][column], frame, picture.scale);
      put(painter.paint(list, frame), painter.srgb, layout, layout.left + int(column) * layout.panel_width,
          layout.panel_top[row], image);
    }
  return image;
}

}  // namespace crosscheck::render
