#include "tests/app/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/io/temporary_folder.h"

extern char** environ;

namespace curlew::test {
namespace {

std::string temporary_file() {
  std::string name = (std::filesystem::temp_directory_path() / "curlew-said-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) throw std::runtime_error("cannot make a temporary file");
  ::close(file);
  return name;
}

// Waiting threads sleep unless a test says otherwise: several programs and their threads share few cores here.
std::vector<std::string> environment_with(std::map<std::string, std::optional<std::string>> changes) {
  changes.try_emplace("OMP_WAIT_POLICY", "passive");
  std::vector<std::string> lines;
  for (char** line = environ; *line != nullptr; ++line) {
    const std::string text = *line;
    if (!changes.contains(text.substr(0, text.find('=')))) lines.push_back(text);
  }
  for (const auto& [name, value] : changes) {
    if (value) lines.push_back(name + "=" + *value);
  }
  return lines;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

Process::Process(const std::vector<std::string>& words, const Setting& setting)
    : setting_(setting), out_(setting.out.empty() ? temporary_file() : setting.out), err_(temporary_file()) {
  std::vector<std::string> arguments = words, environment = environment_with(setting.environment);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), O_WRONLY | O_TRUNC, 0);
  if (!setting.folder.empty()) posix_spawn_file_actions_addchdir_np(&files, setting.folder.c_str());
  const int error = posix_spawnp(&id_, arguments[0].c_str(), &files, nullptr, pointers(arguments).data(),
                                 pointers(environment).data());
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("cannot start " + words[0]);
}

Process::~Process() {
  if (!ended_) {
    send(SIGKILL);
    reap(0);
  }
  if (setting_.out.empty()) ::unlink(out_.c_str());
  ::unlink(err_.c_str());
}

void Process::send(int signal) const { ::kill(id_, signal); }

void Process::reap(int options) {
  if (!ended_ && ::waitpid(id_, &status_, options) == id_) ended_ = true;
}

bool Process::running() {
  reap(WNOHANG);
  return !ended_;
}

Outcome Process::wait() {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  const auto end = Clock::now() + std::chrono::duration<double>(setting_.time_limit);
  while (running()) {
    if (!outcome.too_slow && Clock::now() > end) {
      outcome.too_slow = true;
      send(SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (WIFEXITED(status_)) outcome.code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) outcome.signal = WTERMSIG(status_);
  if (setting_.out.empty()) outcome.out = file_text(out_);
  outcome.err = file_text(err_);
  return outcome;
}

Outcome run_program(const std::vector<std::string>& words, const Setting& setting) {
  return Process(words, setting).wait();
}

Outcome curlew_program(const std::vector<std::string>& words, const Setting& setting) {
  std::vector<std::string> all = {CURLEW_PROGRAM};
  all.insert(all.end(), words.begin(), words.end());
  return run_program(all, setting);
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word == "''" ? "" : word);
  return words;
}

}  // namespace curlew::test
