// Numbers with a point, whatever language the program that calls us has chosen.
#pragma once

#include <clocale>

namespace chainreel {

// As long as this lives, libraries of C read and write numbers in its thread as in the "C" locale: encoders take their
// settings as text.
class PlainNumbers {
 public:
  PlainNumbers();
  ~PlainNumbers();
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  locale_t plain_;   // null where there is no memory for it
  locale_t before_;  // of this thread
};

}  // namespace chainreel
