#include "workers.h"

#if defined(_WIN32)

namespace detent_tool {

bool can_fork() { return false; }

void verify_in_workers(const std::vector<std::string>&, uint32_t,
                       const std::function<Outcome(const std::string&, const Progress&)>&,
                       const std::function<void(const std::string&, const Outcome&)>&) {}

}  // namespace detent_tool

#else

#include <poll.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "progress.h"

namespace detent_tool {

namespace {

/// The fields of an outcome as bytes, which a process sends to its parent. Both run the same program on the same
/// machine, so the bytes need no portable format.
class Parcel {
 public:
  explicit Parcel(std::string bytes = {}) : bytes_(std::move(bytes)) {}
  const std::string& bytes() const { return bytes_; }
  bool complete() const { return good_ && at_ == bytes_.size(); }

  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  template <class T>
  void take(T& value) {
    good_ = good_ && bytes_.size() - at_ >= sizeof value;
    if (!good_) return;
    memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void take(std::string& text) {
    size_t count = 0;
    take(count);
    good_ = good_ && bytes_.size() - at_ >= count;
    if (!good_) return;
    text = bytes_.substr(at_, count);
    at_ += count;
  }

 private:
  std::string bytes_;
  size_t at_ = 0;
  bool good_ = true;
};

/// Lists each field once, for writing and reading.
template <class Outcomes, class Move>
void visit(Outcomes& outcome, const Move& move) {
  move(outcome.verdict);
  move(outcome.problem);
  move(outcome.status);
  move(outcome.field);
  move(outcome.offset);
  move(outcome.tick);
  move(outcome.first_bad_tick);
  move(outcome.header_known);
  move(outcome.header.config);
  move(outcome.header.format_version);
  move(outcome.header.simulation_version);
  move(outcome.header.bodies);
  move(outcome.header.contacts);
  move(outcome.header.assets);
  move(outcome.header.trace_level);
  move(outcome.header.digest_interval);
  move(outcome.header.keyframe_interval);
  move(outcome.header.first_tick);
  move(outcome.header.snapshot_bytes);
  move(outcome.file_bytes);
  move(outcome.ticks);
  move(outcome.digests);
  move(outcome.calls);
  move(outcome.digest);
  move(outcome.seconds);
  move(outcome.release);
  move(outcome.difference_text);
  move(outcome.difference);
}

struct Worker {
  pid_t process = -1;
  int answer = -1;  ///< the read end of its pipe
  size_t path = 0;
  std::string bytes;
};

Outcome broken(const std::string& problem) {
  Outcome outcome;
  outcome.verdict = Verdict::bad;
  outcome.status = "crashed";
  outcome.problem = problem;
  return outcome;
}

bool start(Worker& worker, const std::string& path,
           const std::function<Outcome(const std::string&, const Progress&)>& verify) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  fflush(stdout);
  fflush(stderr);
  worker.process = fork();
  if (worker.process == 0) {
    close(ends[0]);
    Parcel parcel;
    Outcome outcome = verify(path, [](uint64_t, uint64_t) {});
    visit(outcome, [&parcel](const auto& field) { parcel.put(field); });
    const std::string& bytes = parcel.bytes();
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t count = ::write(ends[1], bytes.data() + at, bytes.size() - at);
      if (count <= 0) _exit(1);
      at += static_cast<size_t>(count);
    }
    _exit(0);
  }
  close(ends[1]);
  if (worker.process < 0) close(ends[0]);
  worker.answer = ends[0];
  return worker.process > 0;
}

Outcome end(Worker& worker) {
  close(worker.answer);
  int status = 0;
  if (waitpid(worker.process, &status, 0) != worker.process) return broken("its process was lost");
  if (WIFSIGNALED(status)) {
    return broken(std::string("its process was ended by a signal: ") + strsignal(WTERMSIG(status)));
  }
  Outcome outcome;
  Parcel parcel(std::move(worker.bytes));
  visit(outcome, [&parcel](auto& field) { parcel.take(field); });
  return parcel.complete() ? outcome : broken("its process broke off");
}

}  // namespace

bool can_fork() { return true; }

void verify_in_workers(const std::vector<std::string>& paths, uint32_t jobs,
                       const std::function<Outcome(const std::string&, const Progress&)>& verify,
                       const std::function<void(const std::string&, const Outcome&)>& done) {
  ProgressBar bar("verify");
  std::vector<Worker> workers;
  size_t next = 0, ended = 0;
  while (ended < paths.size()) {
    while (workers.size() < jobs && next < paths.size()) {
      Worker worker;
      worker.path = next;
      if (start(worker, paths[next], verify)) {
        workers.push_back(std::move(worker));
      } else if (workers.empty()) {
        done(paths[next], broken("no process can be started"));
        ++ended;
      } else {
        break;  // retry after another worker has ended
      }
      ++next;
    }
    std::vector<pollfd> answers;
    for (const Worker& worker : workers) answers.push_back({worker.answer, POLLIN, 0});
    if (answers.empty() || poll(answers.data(), answers.size(), -1) < 0) continue;
    for (size_t i = workers.size(); i-- > 0;) {
      if (answers[i].revents == 0) continue;
      char piece[4096];
      const ssize_t got = ::read(workers[i].answer, piece, sizeof piece);
      if (got > 0) {
        workers[i].bytes.append(piece, static_cast<size_t>(got));
        continue;
      }
      const std::string& path = paths[workers[i].path];
      const Outcome outcome = end(workers[i]);
      workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(i));
      bar.hide();
      done(path, outcome);
      bar.show(++ended, paths.size());
    }
  }
}

}  // namespace detent_tool

#endif
