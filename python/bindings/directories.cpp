#include <pybind11/stl.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "bindings.h"
#include "subimpact/io/output_directory.h"

namespace subimpact::python {
namespace {

constexpr std::chrono::milliseconds pause{50};

// The directory of a sweep, whose processes are copies (fork) of the one that made this object:
// the copies leave lock and files alone.
class Directory {
 public:
  Directory(const std::string& path, const std::string& kind, double patience,
            const std::string& identity)
      : owner_(getpid()) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
    for (;;) {
      try {
        directory_ = std::make_unique<OutputDirectory>(path, kind, identity);
        return;
      } catch (const DirectoryInUse&) {
        if (std::chrono::steady_clock::now() > give_up) throw;
      }
      std::this_thread::sleep_for(pause);
    }
  }
  ~Directory() { close(); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  void close() {
    if (getpid() == owner_) {
      directory_.reset();
    } else {
      static_cast<void>(directory_.release());
    }
  }
  OutputDirectory& open() const {
    if (!directory_) throw OutputError("this directory of results is closed");
    return *directory_;
  }

 private:
  pid_t owner_;
  std::unique_ptr<OutputDirectory> directory_;
};

}  // namespace

void bind_directories(py::module_& module) {
  py::class_<Directory>(module, "OutputDirectory")
      .def(py::init<const std::string&, const std::string&, double, const std::string&>(),
           py::arg("directory"), py::arg("kind"), py::arg("patience_s") = 0.0,
           py::arg("identity") = "", py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("staging",
                             [](const Directory& d) { return d.open().staging().string(); })
      .def(
          "commit", [](const Directory& d) { d.open().commit(); },
          py::call_guard<py::gil_scoped_release>())
      .def("close", &Directory::close);
}

}  // namespace subimpact::python
