// picture SCENE.yaml FILE.png: runs the scene, prints its first joint and its energy, and draws the middle of its film.
#include <chainreel/film.hpp>

#include <cstdio>

int main(int count, char** words) try {
  if (count != 3) return std::fprintf(stderr, "usage: picture SCENE.yaml FILE.png\n"), 2;
  const chainreel::SceneRun run({.path = words[1]});
  for (const std::string& line : run.warnings()) std::fprintf(stderr, "%s\n", line.c_str());

  const chainreel::Trajectory& motion = run.trajectory();
  const std::vector<double>& energy = run.energy().total;
  for (int k = 0; k < motion.size(); k += motion.size() / 5)
    std::printf("t = %.2f s  q1 = %+.4f  E = %+.6f J\n", motion.t[k], motion.q_at(k)[0], energy[k]);
  run.picture(motion.end_time / 2, words[2], true);
  // The whole film: run.film({.files = {"film.mp4"}});
} catch (const chainreel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return int(error.code());
}
