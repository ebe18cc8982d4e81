"""The package as cmake --install leaves it below a prefix, the only argument."""

import os
import subprocess
import sys
import tempfile

import subimpact

prefix = os.path.realpath(sys.argv[1])
assert os.path.realpath(subimpact.__file__).startswith(prefix), subimpact.__file__
case = subimpact.Case(
    beam=dict(length=0.5, width=0.02, thickness=0.01, density=7800.0, youngs_modulus=2e11),
    striker=dict(mass=0.1, nose_radius=0.01, velocity=1.0),
    contact=dict(law="hertz", stiffness=5e9),
    model=dict(mesh="rigid"),
    time=dict(end=1e-3),
)
result = subimpact.run(case)
assert result.outcome == "completed", result
assert len(result.sub_impacts) == 1, result
environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
help_text = subprocess.run(
    [prefix + "/bin/subimpact-sweep", "--help"], env=environment, capture_output=True, text=True, check=True
)
assert "--workers" in help_text.stdout
version = subprocess.run([prefix + "/bin/subimpact", "--version"], env=environment, capture_output=True, text=True, check=True)
assert subimpact.__version__ in version.stdout
found = subprocess.run([prefix + "/bin/subimpact", "python", "-c", "import subimpact; print(subimpact.__file__)"],
                       env=environment, capture_output=True, text=True, check=True)
assert os.path.realpath(found.stdout.strip()).startswith(prefix), found.stdout
with tempfile.TemporaryDirectory() as directory:
    result.write(directory)
    subprocess.run([prefix + "/bin/subimpact", "report", directory], env=environment, check=True)
    with open(directory + "/report.html", encoding="utf-8") as page:
        assert "class Strike" in page.read()
