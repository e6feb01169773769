// Runs the program as a user would: words in, exit code and what it says out, with a limit on the time that it takes.
#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace curlew::test {

struct Outcome {
  int code = -1;          // exit code, or -1 where a signal ended the program
  int signal = 0;         // that signal
  bool too_slow = false;  // ended by us, after the time limit
  std::string out, err;
};

struct Setting {
  std::string folder = {};                                             // the working folder
  std::map<std::string, std::optional<std::string>> environment = {};  // changes; nullopt removes
  std::string out = {};     // a file such as /dev/full for standard output; then Outcome::out stays empty
  double time_limit = 100;  // s; generous, since others may need the cores
};

// A program that runs. The destructor ends it.
class Process {
 public:
  Process(const std::vector<std::string>& words, const Setting& setting);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const;
  bool running();
  // Waits for the end. Call once.
  Outcome wait();

 private:
  void reap(int options);

  Setting setting_;
  pid_t id_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string out_, err_;  // files
};

// The program curlew with these words.
Outcome curlew_program(const std::vector<std::string>& words, const Setting& setting = {});
// Any other program, found on PATH.
Outcome run_program(const std::vector<std::string>& words, const Setting& setting = {});

// "run dam_break --steps 3" as words; '' is an empty one.
std::vector<std::string> words_of(const std::string& line);

}  // namespace curlew::test
