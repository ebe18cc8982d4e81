"""Builds the Python package with CMake, for pip and other frontends (PEP 517).

Everything comes from pyproject.toml and CMakeLists.txt. The settings of the frontend:

  build-dir=DIR     builds there and leaves it: a second build takes seconds. Default: a directory that is removed
  native=ON         compiles for this machine's processor alone, which is faster; other machines may refuse the wheel

The compilers are those of CXX and of Debian's packages (README.md); ccache is used if it is there.
"""

import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.9 and 3.10
    from pip._vendor import tomli as tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEFT_OUT = {".git", "__pycache__", ".cache"}  # of an sdist, with build directories and results


def _project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    version = re.search(r"^project\(subimpact VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.M)
    return {**project, "version": version[1]}


def _metadata(project):
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    lines += ["Description-Content-Type: text/markdown", "", (ROOT / project["readme"]).read_text()]
    return "\n".join(lines)


def _run(*command):
    # pip's isolated environment would hide the system's NumPy from the interpreter that CMake asks.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    print("+", *command, flush=True)
    if subprocess.run(command, env=environment, check=False).returncode != 0:
        raise SystemExit(f"{command[0]} failed; what it needs is above. On Debian: apt install cmake ninja-build g++ "
                         "libsundials-dev libsuitesparse-dev libeigen3-dev libfmt-dev nlohmann-json3-dev "
                         "libtomlplusplus-dev libssl-dev python3-dev python3-numpy pybind11-dev")


def _build(directory, settings):
    options = [f"-DPython_EXECUTABLE={sys.executable}"]
    if not (directory / "CMakeCache.txt").exists():
        options += ["-GNinja", "-DCMAKE_BUILD_TYPE=Release", "-DSUBIMPACT_PYTHON=ON",
                    f"-DSUBIMPACT_NATIVE={settings.get('native', 'OFF')}",
                    *(f"-DSUBIMPACT_{part}=OFF" for part in ("EXAMPLES", "TESTS", "BENCHMARKS", "INSTALL"))]
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
    _run("cmake", "-S", str(ROOT), "-B", str(directory), *options)
    _run("cmake", "--build", str(directory), "--target", "subimpact_python", "subimpact")
    return directory / "python" / "subimpact", directory / "bin" / "subimpact"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    project = _project()
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    stem = f"{project['name']}-{project['version']}"
    with tempfile.TemporaryDirectory() as temporary:
        package, program = _build(pathlib.Path(settings.get("build-dir", temporary)).resolve(), settings)
        contents = {f"subimpact/{path.relative_to(package).as_posix()}": path.read_bytes()
                    for path in sorted(package.rglob("*"))
                    if path.is_file() and (path.suffix in {".py", ".pyi", ".so", ".js", ".css", ".html"} or path.name == "py.typed")}
        contents[f"{stem}.data/scripts/subimpact"] = program.read_bytes()
    scripts = "".join(f"{name} = {target}\n" for name, target in project["scripts"].items())
    contents |= {
        f"{stem}.dist-info/METADATA": _metadata(project).encode(),
        f"{stem}.dist-info/WHEEL": f"Wheel-Version: 1.0\nGenerator: cmake_backend\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(),
        f"{stem}.dist-info/entry_points.txt": f"[console_scripts]\n{scripts}".encode(),
        f"{stem}.dist-info/LICENSE": (ROOT / "LICENSE").read_bytes()}
    record = ""
    for name, content in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    contents[f"{stem}.dist-info/RECORD"] = f"{record}{stem}.dist-info/RECORD,,\n".encode()
    wheel = f"{stem}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents.items():
            information = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            is_program = name.endswith((".so", "scripts/subimpact"))
            information.external_attr = (0o100755 if is_program else 0o100644) << 16
            archive.writestr(information, content, zipfile.ZIP_DEFLATED)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    project = _project()
    stem = f"{project['name']}-{project['version']}"

    def kept(entry):
        name = pathlib.PurePosixPath(entry.name).name
        top = len(pathlib.PurePosixPath(entry.name).parts) == 2
        is_built = name.endswith("-results") or (top and (name.startswith("build") or name.startswith("out")))
        return None if name in LEFT_OUT or (entry.isdir() and is_built) else entry

    with tarfile.open(pathlib.Path(sdist_directory) / f"{stem}.tar.gz", "w:gz") as archive:
        archive.add(ROOT, stem, filter=kept)
        information = tarfile.TarInfo(f"{stem}/PKG-INFO")
        content = _metadata(project).encode()
        information.size = len(content)
        archive.addfile(information, io.BytesIO(content))
    return f"{stem}.tar.gz"
