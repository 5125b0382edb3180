// What most tests read first; see tests/CMakeLists.txt.
