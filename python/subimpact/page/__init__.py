"""Pages of HTML of finished runs and sweeps, made of their files: `subimpact report DIR` runs this module. A page is
self-contained, style, figures, data and scripts are in it, and valid XML. Of a run it needs Python alone; those of sweeps
and of several runs hold figures, for which they need what `subimpact.plot` needs.
"""
