"""What is on which menu of the site, and which pages are cut in two there.

Paths are those in the project, or those under reference/, which reference.py writes. Pages of docs/
that are on no menu come last in `Use`; every README.md of validation/ and benchmarks/ has its place.
"""

MENUS = {
    "Start": "README.md",
    "Use": {
        "Tutorial": "docs/tutorial.md",
        "Gallery": "docs/gallery.md",
        "Install": "docs/library.md",
        "Case file": "docs/case-file.md",
        "Every key": "reference/keys.md",
        "Results": "docs/results.md",
        "Tables and files": "docs/files.md",
        "Every column": "reference/columns.md",
        "Commands": "reference/commands.md",
        "Populations, Python": "docs/populations.md",
        "Limits of inputs": "docs/limits.md",
    },
    "Understand": {
        "Glossary": "docs/glossary.md",
        "What the model holds": "docs/model.md",
        "Which law of contact": "docs/contact-laws.md",
        "Methods and meshes": "docs/methods.md",
        "The published example": "docs/published-example.md",
        "Equations": {
            "Scene and symbols": "docs/theory.md",
            "The beam": "docs/theory/beam.md",
            "Meshes": "docs/theory/meshes.md",
            "Bending with yield": "docs/theory/bending.md",
            "Contact": "docs/theory/contact.md",
            "Events": "docs/theory/events.md",
            "Accounts": "docs/theory/accounts.md",
            "Time integration": "docs/theory/integration.md",
            "Error estimates": "docs/theory/errors.md",
            "Predictability": "docs/theory/predictability.md",
        },
    },
    "Extend": {
        "Architecture": "docs/architecture.md",
        "Python package": "reference/python.md",
        "C++ headers": "reference/cpp/",  # all pages of the folder
        "Contributing": "CONTRIBUTING.md",
        "Changes": "CHANGELOG.md",
    },
    "Check": {
        "All comparisons": "validation/README.md",
        "Against physics": "validation/physics/",
        "Against finer runs": "validation/truth/",
        "What it costs": "validation/cost/",
        "Other programs": "benchmarks/",
    },
}

# Pages too long to read in one go: at each of these headings the site begins another page.
CUT_AT = {
    "docs/architecture.md": ["Recipes"],
    "validation/physics/continuum/README.md": ["The published strike", "Steel, struck off the middle"],
}

# Pages to look things up in, of any length.
LISTINGS = ["reference/", "source/", "CHANGELOG.md", "validation/README.md"]

MOST_WORDS = 2500  # of any other page

# Single words that people type for what a page calls otherwise; the search knows them, nobody sees them.
OTHER_WORDS = {
    "docs/case-file.md": ["units", "toml", "si", "input"],
    "docs/contact-laws.md": ["steel", "material"],
    "docs/files.md": ["strain", "csv"],
    "docs/gallery.md": ["examples", "steel", "drop", "pictures"],
    "docs/glossary.md": ["terms", "definitions"],
    "docs/library.md": ["debian", "pip", "download"],
    "docs/methods.md": ["convergence", "solver", "integrator"],
    "docs/model.md": ["assumptions", "validity"],
    "docs/populations.md": ["numpy", "parallel"],
    "docs/results.md": ["output", "rebound"],
    "docs/theory/errors.md": ["accuracy", "uncertainty"],
    "docs/theory/meshes.md": ["convergence", "discretisation"],
    "docs/tutorial.md": ["units", "introduction", "begin"],
}
