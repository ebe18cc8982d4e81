"""A golf ball that bounces on marble, as measured and as computed."""

import subimpact as si

# Height of the drop (m), coefficient of restitution of the first bounce (from the height of its rebound), intervals
# between touches 1 and 2, and 8 and 9 (s), and the standard error of the latter.
MEASURED = [(0.80, 0.8932, 0.7229, 0.3405, 0.0056), (0.90, 0.8943, 0.7623, 0.3524, 0.0087),
            (1.00, 0.8889, 0.8007, 0.3718, 0.0070), (1.10, 0.8882, 0.8396, 0.3797, 0.0055)]


def intervals(height, restitution):
    case = si.Case({"striker.mass": 0.0415, "striker.drop_height": height, "scene.gravity": 9.81, "beam.fixed": True,
                    "contact.law": "hertz", "contact.stiffness": 1e7, "contact.restitution": restitution, "time.end": 5.5})
    starts = si.run(case, body_errors=False).sub_impacts["start_s"]
    return starts[1] - starts[0], starts[8] - starts[7]


print("| drop, m | e | interval 1: measured, s | computed | interval 8: measured | computed | difference |")
print("|---|---|---|---|---|---|---|")
for height, restitution, first, eighth, error in MEASURED:
    one, eight = intervals(height, restitution)
    print(f"| {height:.2f} | {restitution} | {first} | {one:.4f} | {eighth} +- {error} | {eight:.4f} | {100 * (eight / eighth - 1):+.1f} % |")
