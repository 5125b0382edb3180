// The pictures that a suite was accepted with, in a folder beside it: NAME.png, what they show in NAME.json,
// records of models and runs in records/, the cameras there in cameras.json. They change all together or not
// at all.
#pragma once

#include <map>
#include <mutex>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/verify/shots.hpp"
#include "core/temporary_file.hpp"

namespace chainreel {

struct Baseline {
  Image image;
  std::string png;  // the file's bytes
  Json physics;     // as in SuiteShot, its records in it
  Json page;
};

// Keeps others from writing a suite's baselines, or, while they are written, from reading them. Waits until
// it may.
class SuiteLock {
 public:
  enum class For { reading, writing };
  // Throws Error (exit 6) where the suite cannot be locked, the signal's Error where one comes.
  SuiteLock(const Suite& suite, For purpose);
  ~SuiteLock();
  SuiteLock(const SuiteLock&) = delete;
  SuiteLock& operator=(const SuiteLock&) = delete;

 private:
  int file_ = -1;
};

class Baselines {
 public:
  explicit Baselines(const Suite& suite);

  const std::string& folder() const { return folder_; }  // it may not be there
  bool exist() const;
  std::set<std::string> names() const;
  bool has(const std::string& name) const;
  // Throws Error (exit 3) of one that is no picture, belongs to another suite or was changed by hand.
  Baseline read(const std::string& name) const;
  Cameras cameras() const;
  std::string camera_file() const;

 private:
  std::string folder_;
  std::string suite_;
};

// A change of baselines. Nothing of it is seen before commit(), and then all of it.
class BaselineUpdate {
 public:
  // Begins with what there is. Throws Error (exit 6) where the folder cannot be written.
  BaselineUpdate(const Suite& suite, const Baselines& old);

  void set(const std::string& name, const SuiteShot& shot);  // safe among threads
  void remove(const std::string& name);
  void set_cameras(const Cameras& cameras);
  void commit();

 private:
  std::string keep_record(const Json& record);
  void keep_modes() const;
  void drop_unused_records() const;

  std::string folder_, suite_;
  std::unique_ptr<TemporaryFile> coming_;
  std::mutex records_;
};

// The names of the file of a picture and of its facts, in a folder of baselines.
std::string picture_file_of(const std::string& name);

}  // namespace chainreel
