// What MuJoCo's own example `record` does, for a double pendulum: simulate, draw without a window by OSMesa, read back, hand the
// raw frames on. mujoco_film WIDTH HEIGHT FPS SECONDS SHADOWS(0|1) writes RGB rows from the bottom up to standard output.
#include <GL/osmesa.h>
#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr const char* kModel = R"(<mujoco>
  <option timestep="0.001"/>
  <visual><global offwidth="4096" offheight="4096"/></visual>
  <asset><texture name="floor" type="2d" builtin="checker" width="256" height="256" rgb1=".9 .9 .9" rgb2=".8 .8 .8"/>
    <material name="floor" texture="floor" texrepeat="4 4"/></asset>
  <worldbody>
    <light pos="0 -2 3" dir="0 0.5 -1" castshadow="true"/>
    <geom type="plane" size="3 3 .1" pos="0 0 -2.2" material="floor"/>
    <body><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".04" mass="1" rgba=".2 .4 .8 1"/>
      <body pos="1 0 0"><joint axis="0 1 0"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".04" mass="1" rgba=".8 .4 .2 1"/></body>
    </body>
  </worldbody>
</mujoco>)";

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "mujoco_film: %s\n", what);
  std::exit(4);
}

}  // namespace

int main(int count, char** words) {
  if (count != 6) fail("WIDTH HEIGHT FPS SECONDS SHADOWS are wanted");
  const int width = std::atoi(words[1]), height = std::atoi(words[2]), fps = std::atoi(words[3]);
  const int frames = fps * std::atoi(words[4]);

  std::vector<unsigned char> page(4 * std::size_t(width) * std::size_t(height)), pixels(3 * page.size() / 4);
  OSMesaContext context = OSMesaCreateContextExt(GL_RGBA, 24, 8, 8, nullptr);
  if (context == nullptr || !OSMesaMakeCurrent(context, page.data(), GL_UNSIGNED_BYTE, width, height))
    fail("OSMesa gives no context");

  std::FILE* file = std::tmpfile();
  std::fputs(kModel, file);
  std::fflush(file);
  char path[64], error[500] = "";
  std::snprintf(path, sizeof path, "/proc/self/fd/%d", fileno(file));
  mjModel* model = mj_loadXML(path, nullptr, error, sizeof error);
  if (model == nullptr) fail(error);
  mjData* data = mj_makeData(model);

  mjvCamera camera;
  mjvOption option;
  mjvScene scene;
  mjrContext renderer;
  mjv_defaultCamera(&camera);
  camera.lookat[2] = -0.5;
  camera.distance = 5;
  mjv_defaultOption(&option);
  mjv_defaultScene(&scene);
  mjr_defaultContext(&renderer);
  mjv_makeScene(model, &scene, 100);
  mjr_makeContext(model, &renderer, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &renderer);
  scene.flags[mjRND_SHADOW] = mjtByte(words[5][0] == '1');
  scene.flags[mjRND_REFLECTION] = 0;

  for (int frame = 0; frame < frames; ++frame) {
    while (data->time * fps < frame) mj_step(model, data);
    mjv_updateScene(model, data, &option, nullptr, &camera, mjCAT_ALL, &scene);
    const mjrRect view{0, 0, width, height};
    mjr_render(view, &scene, &renderer);
    mjr_readPixels(pixels.data(), nullptr, view, &renderer);
    if (std::fwrite(pixels.data(), 1, pixels.size(), stdout) != pixels.size()) fail("nobody takes the frames");
  }
  mjr_freeContext(&renderer);
  mjv_freeScene(&scene);
  mj_deleteData(data);
  mj_deleteModel(model);
  OSMesaDestroyContext(context);
  std::fclose(file);
}
