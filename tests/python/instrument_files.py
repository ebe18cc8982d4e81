"""Files of one strike as instruments and spreadsheets write them, and what reading them must give.

The strike: 400 samples 2 us apart from -100 us on, a half sine of 1200 N over 400 us from 0 on.
"""

import math
import re
from dataclasses import dataclass, field

N, STEP, BEGIN, PEAK = 400, 2e-6, -1e-4, 1200.0
TIMES = [BEGIN + i * STEP for i in range(N)]
FORCES = [PEAK * math.sin(math.pi * t / 4e-4) if 0 < t < 4e-4 else 0.0 for t in TIMES]
MASS = 0.201  # kg
GRAVITY = 9.80665  # m/s^2
CHARGE_AMPLIFIER = "2.27 mV/N"


@dataclass
class File:
    name: str
    content: bytes
    options: dict = field(default_factory=dict)  # what the file does not state
    refusal: str = ""  # and what the message without these options must have
    n: int = N
    begin: float = BEGIN  # s
    accuracy: float = 1e-3  # of the largest force

    def times(self):
        return [self.begin + i * STEP for i in range(self.n)]


def rows(time, force, separator=",", time_format="{:.4f}", force_format="{:.5f}", comma=False, end="\n",
         before="", after=""):
    """Rows of times and forces in units, each times a factor."""
    lines = (before + time_format.format(t * time) + separator + force_format.format(f * force) + after
             for t, f in zip(TIMES, FORCES))
    text = "".join(line + end for line in lines)
    return text.replace(".", ",") if comma else text


def picoscope(unit, factor):
    return f"Time,Channel A\r\n(us),({unit})\r\n\r\n" + rows(1e6, factor, end="\r\n", time_format="{:.8f}", force_format="{:.8f}")


def tektronix_tds():
    """The metadata stand in the first columns of the rows themselves."""
    metadata = [("Record Length", "4.000000e+02"), ("Sample Interval", "2.000000e-06"), ("Trigger Point", "5.0e+01"),
                ("", ""), ("", ""), ("Source", "CH1"), ("Vertical Units", "V"), ("Vertical Scale", "5.000000e-01"),
                ("Vertical Offset", "0.000000e+00"), ("Horizontal Units", "s"), ("Horizontal Scale", "2.5e-04"),
                ("Pt Fmt", "Y"), ("Yzero", "0.000000e+00"), ("Probe Atten", "1.000000e+00"), ("Model Number", "TDS2014B"),
                ("Serial Number", "C000000"), ("Firmware Version", "FV:v22.11")]
    lines = []
    for i, (t, f) in enumerate(zip(TIMES, FORCES)):
        key, value = metadata[i] if i < len(metadata) else ("", "")
        lines.append(f"{key},{value},,{t: .12f},{f * 2.27e-3: 10.5f},\n")
    return "".join(lines)


def tektronix_mso(unit):
    return ("Model,MSO4034\nFirmware Version,2.48\n,\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,4e-05,\n,\n"
            "Sample Interval,2e-06,\nFilter Frequency,2.5e+08,\nRecord Length,400,\nGating,0.0% to 100.0%,\n"
            f"Probe Attenuation,10,\nVertical Units,{unit},\nVertical Offset,0,\nVertical Scale,1,\n,\nLabel,,\nTIME,CH1\n"
            + rows(1, 1, time_format="{:.6e}"))


def rigol():
    lines = [f"{i},{f * 2.27e-3:.6e},\n" for i, f in enumerate(FORCES)]
    return f"X,CH1,Start,Increment,\nSequence,Volt,{BEGIN:.6e},{STEP:.6e}\n" + "".join(lines)


def lecroy():
    return ("LECROYWS3024,12345,Waveform\nSegments,1,SegmentSize,400\nSegment,TrigTime,TimeSinceSegment1\n"
            "#1,13-Mar-2020 14:22:11,0\nTime,Ampl\n" + rows(1, 2.27e-3, time_format="{:.6e}"))


def labview(comma=False, times=True):
    head = ("LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n"
            "Multi_Headings\tNo\nX_Columns\t" + ("One" if times else "No") + "\nTime_Pref\tRelative\nOperator\tLab\n"
            "Date\t2015/03/11\nTime\t17:37:59.5\n***End_of_Header***\t\n\t\nChannels\t1\t\nSamples\t400\t\n"
            "Date\t2015/03/11\t\nTime\t17:37:59.5\t\nY_Unit_Label\tN\t\nX_Dimension\tTime\t\nX0\t-1.0000000000000000E-4\t\n"
            "Delta_X\t2.000000E-6\t\n***End_of_Header***\t\t\nX_Value\tForce\tComment\n")
    body = rows(1, 1, "\t", time_format="{:.6f}") if times else "".join(f"\t{f:.5f}\t\n" for f in FORCES)
    text = head + body
    return text.replace(".\n", ",\n").replace(".", ",") if comma else text


def labview_of_two():
    """Channels of two units: a trigger in volts and the force."""
    text = labview().replace("Y_Unit_Label\tN\t", "Y_Unit_Label\tV\tN").replace("X_Value\tForce", "X_Value\tTrigger\tLoad")
    head, body = text.split("Comment\n")
    return head + "Comment\n" + "".join(line.replace("\t", "\t5.0\t") + "\n" for line in body.splitlines())


def scopy():
    lines = [f"{i},{t:.7g},{f * 2.27e-3:.6g},0.001,\n" for i, (t, f) in enumerate(zip(TIMES, FORCES))]
    return (";Scopy version,9a2a1c3\n;Exported on,Wed Mar 4 11:45:28 2020\n;Device,M2K\n;Nr of samples,400\n"
            ";Sample rate,500000\n;Tool: Oscilloscope\n;Additional Information: \nSample,Time(S),CH1(V),CH2(V),\n" + "".join(lines))


def yokogawa():
    head = ('"Header Size",12\n"Model Name","DL850"\n"Comment",""\n"TraceName","CH1"\n"BlockSize",400\n"VUnit","N"\n'
            '"SampleRate",5.0000000E+05\n"HResolution",2.0000000E-06\n"HOffset",-1.0000000E-04\n"HUnit","s"\n'
            '"Date","2012/05/24"\n"Time","13:45:58.12"\n')
    return head + "".join(f'"",{f:.5E}\n' for f in FORCES)


def with_gaps():
    lines = rows(1e3, 1, ",").splitlines()
    for i, cell in ((10, "NaN"), (20, ""), (30, "inf"), (40, "-inf"), (51, "#N/A")):
        lines[i] = lines[i].split(",")[0] + "," + cell
    return "time_ms,force_N\n" + "\n".join(lines) + "\n"


def repeated_times():
    """Times with too few digits: each stands twice; the means are half a sample later."""
    lines = [f"{4.0 * (i // 2) - 100:.0f}\t{f:.4f}\n" for i, f in enumerate(FORCES)]
    return "t [us]\tF [N]\n" + "".join(lines)


def with_overrange():
    """Cells that instruments write where they know no number."""
    lines = rows(1e3, 1, ",").splitlines()
    for i, cell in ((110, "9.9E+37"), (120, "1.#QNAN"), (130, "-1.#IND"), (140, "1.#INF"), (150, "nan(ind)")):
        lines[i] = lines[i].split(",")[0] + "," + cell
    return "time_ms,force_N\n" + "\n".join(lines) + "\n"


def hioki():
    """A blank between sign and digits."""
    return "Time[s],CH1[N]\n" + re.sub(r"([-+])(?=\d+\.)", r"\1 ", rows(1, 1, time_format="{:+.6f}", force_format="{:+.3f}"))


def spans(days, hours):
    """Times as spans, of pandas and of Python's datetime."""
    seconds = (f"{t % 86400:.6f}" for t in TIMES)
    return "time,force_N\n" + "".join(f"{days(t)}{hours(float(s))},{f:.4f}\n" for t, s, f in zip(TIMES, seconds, FORCES))


def universal(even=True, double=True, unit="N", more=""):
    """Data set 58 in text: records of 80 characters, by its specification."""
    head = ["hammer", "NONE", "01-Jan-26 12:00:00", "NONE", "NONE", f"{1:5d}{0:10d}{0:5d}{0:10d} {'NONE':10s}{1:10d}{3:4d} {'NONE':10s}{0:10d}{0:4d}",
            f"{4 if double else 2:10d}{N:10d}{int(even):10d}{BEGIN:13.5e}{STEP:13.5e}{0:13.5e}"]
    head += [f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:20s} {symbol:20s}" for kind, label, symbol in (
        (17, "Time", "s"), (13, "Excitation", unit), (0, "NONE", "NONE"), (0, "NONE", "NONE"))]
    numbers = [f"{f:20.12e}" if double else f"{f:13.5e}" for f in FORCES]
    if not even:
        numbers = [f"{t:13.5e}{f}" for t, f in zip(TIMES, numbers)]
    per_line = 80 // len(numbers[0])
    rows = ["".join(numbers[i:i + per_line]) for i in range(0, N, per_line)]
    return "\n".join(["    -1", "    58", *head, *rows, "    -1", ""]) + more


def clock(form, mark=".", before="", after=""):
    """Times of day, from 12:03:04.1234 on."""
    def cell(t):
        seconds = f"{4.1235 + t:09.6f}".replace(".", mark)
        return form.format(f"12:03:{seconds}")
    return "".join(f"{cell(t)};{f:.4f}\n".replace(".", mark if mark == "," else ".") for t, f in zip(TIMES, FORCES))


def acceleration(unit, factor):
    """Of the striker, which slows down."""
    return f"Time [ms];Acceleration [{unit}]\n" + rows(1e3, -1.0 / MASS * factor, ";")


def interval_in_a_comment(line):
    return f"# load cell 9001A\n# {line}\n# unit: N\nforce\n" + "".join(f"{f:.4f}\n" for f in FORCES)


def all_files():
    in_volts = {"sensitivity": CHARGE_AMPLIFIER}
    german = "Zeit [ms];Kraft [kN]\r\n" + rows(1e3, 1e-3, ";", comma=True, end="\r\n", force_format="{:.6f}")
    yield File("picoscope-kN.csv", picoscope("kN", 1e-3).encode())
    yield File("picoscope-mV.csv", picoscope("mV", 2.27).encode("utf-8-sig"), in_volts, "sensitivity=")
    yield File("tektronix-tds.csv", tektronix_tds().encode(), in_volts, "sensitivity=")
    yield File("tektronix-mso.csv", tektronix_mso("N").encode())
    yield File("rigol.csv", rigol().encode(), in_volts, "sensitivity=")
    yield File("rigol-t0.csv", (f"CH1V,t0 ={BEGIN:.6e}, tInc = {STEP:.6e},\n" + "".join(f"{f * 2.27e-3:.5e},\n" for f in FORCES)).encode(),
               in_volts, "sensitivity=")
    yield File("lecroy.csv", lecroy().encode(), {"units": "s,V", **in_volts}, "units=")
    yield File("labview.lvm", labview().encode())
    yield File("labview-comma.lvm", labview(comma=True).encode())
    yield File("labview-no-times.lvm", labview(times=False).encode())
    yield File("labview-two.lvm", labview_of_two().encode())
    yield File("labview-excitation.lvm", labview().replace("\tForce\t", "\tExcitation [N]\t").replace("Y_Unit_Label\tN\t\n", "").encode())
    yield File("scopy.csv", scopy().encode(), {"columns": (2, 3), **in_volts}, "columns=")
    yield File("yokogawa.csv", yokogawa().encode())
    yield File("excel-german.csv", ("sep=;\r\n" + german).encode("cp1252"))
    yield File("excel-micro.csv", ("Zeit [µs];Kraft [N]\r\n" + rows(1e6, 1, ";", comma=True)).encode("cp1252"))
    yield File("excel-unicode.txt", ("\ufeff" + german.replace(";", "\t")).encode("utf-16-le"))
    yield File("excel-utf16be.txt", ("\ufeff" + german).encode("utf-16-be"))
    yield File("quotes.csv", ('"Time, ms","Force, N"\n' + "".join(f'"{1e3 * t:.4f}"'.replace(".", ",") + "," +
               f'"{f:.4f}"'.replace(".", ",") + "\n" for t, f in zip(TIMES, FORCES))).encode())
    yield File("units-in-second-row.csv", ("Run 7,rail,hammer\ntime,force,trigger\ns,N,\n" + rows(1, 1, time_format="{:.6f}", after=",0")).encode())
    yield File("blanks.dat", ("% hammer blow\n% t [us]   F [kN]\n" + rows(1e6, 1e-3, "   ", before="  ", force_format="{:.6f}")).encode())
    yield File("blanks-comma.dat", ("Time (us)  Force (N)\n" + rows(1e6, 1, "  ", comma=True)).encode())
    yield File("scientific.tsv", ("time [s]\tF [N]\n" + rows(1, 1, "\t", time_format="{:.6e}", force_format="{:.3e}")).encode())
    yield File("gaps.csv", with_gaps().encode(), n=N - 5)
    yield File("overrange.csv", with_overrange().encode(), n=N - 5)
    for i, (even, double, unit) in enumerate(((True, True, "N"), (True, False, "N"), (False, True, "NONE"), (False, False, ""))):
        yield File(f"universal-{i}.uff", universal(even, double, unit).encode())
    unit = "    -1\n   151\nmodel\n    -1\n"
    yield File("universal-two.unv", (unit + universal() + universal().replace("        13 ", "        12 ").replace("N   ", "g   ")).encode())
    yield File("hioki.csv", hioki().encode())
    yield File("timedelta.csv", spans(lambda t: "-1 days +" if t < 0 else "0 days ", lambda s:
               f"{int(s) // 3600:02d}:{int(s) // 60 % 60:02d}:{s % 60:09.6f}").encode())
    for unit, per in (("ft/s^2", 0.3048), ("in/s²", 0.0254), ("cm/s2", 0.01), ("mm/s^2", 1e-3)):
        yield File(f"acceleration-{unit.replace('/', '-')}.csv", acceleration(unit, 1 / per).encode(), {"mass": "0.201 kg"}, "mass=")
    for mass in ("7.09006635 oz", "0.44312914 lbm", "0.0137728 slug"):
        yield File(f"mass-{mass}.csv", acceleration("g", 1 / GRAVITY).encode(), {"mass": mass}, "mass=")
    for other in ("psi", "ksi", "ft", "cm/s", "in/s", "°F", "kPa"):
        yield File(f"beside-{other.replace('/', '-')}.csv", (f"t;Load;Other\ns;lbf;{other}\n"
                   + rows(1, 1 / 4.4482216152605, ";", time_format="{:.6f}", after=";21.5")).encode())
        yield File(f"heading-{other.replace('/', '-')}.csv", (f"t [s];Channel 2 [{other}];Channel 1\n"
                   + rows(1, 1, ";21.5;", time_format="{:.6f}")).encode(), {"units": "s,N"}, "units=")
    noon = 12 * 3600 + 3 * 60 + 4.1235 + BEGIN
    yield File("clock.csv", ("Time;Force [N]\n" + clock("{}")).encode(), begin=noon)
    yield File("clock-date.csv", ("Timestamp;Force [N]\n" + clock("2024-03-12T{}Z")).encode(), begin=noon)
    yield File("clock-german.csv", ("Uhrzeit;Kraft [N]\n" + clock("{}", ",")).encode("cp1252"), begin=noon)
    yield File("dekanewton.csv", ("Time;Force;Temp\nµs;daN;°C\n" + rows(1e6, 0.1, ";", after=";21.5")).encode("cp1252"))
    yield File("swiss.csv", ("Zeit (us);Kraft (N)\n" + re.sub(r"(\d)(\d{3}\.)", r"\1'\2", rows(1e6, 1, ";"))).encode())
    yield File("minus.csv", ("Zeit (us);Kraft (N)\n" + rows(1e6, 1, ";").replace("-", "\u2212")).encode())
    backwards = "\n".join(reversed(rows(1e6, 1, ";").splitlines()))
    yield File("backwards.csv", ("Zeit (us);Kraft (N)\n" + backwards + "\n").encode())
    yield File("factor.csv", ("Yunit,N\nYmult,0.5\nTime (s),CH1\n" + rows(1, 2, time_format="{:.6f}")).encode(), {"scale": 0.5}, "scale=0.5")
    yield File("sensitivity-unit.csv", ("Sensitivity [mV/N]: 2.27\nTime (s),CH1 (V)\n" + rows(1, 2.27e-3, time_format="{:.6f}", force_format="{:.8f}")).encode())
    yield File("repeated.tsv", repeated_times().encode(), n=N // 2, accuracy=0.02)
    yield File("negative.csv", ("time_us,force_N\n" + rows(1e6, -1)).encode(), {"sign": -1}, "sign=-1")
    yield File("no-unit.csv", ("time,force\n" + rows(1e3, 1e-3, force_format="{:.6f}")).encode(), {"units": ("ms", "kN")}, "units=")
    yield File("acceleration-g.csv", acceleration("g", 1 / GRAVITY).encode(), {"mass": MASS, "sign": -1}, "mass=")
    yield File("acceleration-si.csv", acceleration("m/s²", -1.0).encode(), {"mass": "201 g"}, "mass=")
    yield File("thousands-rate.txt", ("Abtastrate: 500.000 Hz\nNr;Kraft [N]\n" + "".join(f"{i};{f:.4f}\n" for i, f in enumerate(FORCES))
               .replace(".", ",")).encode(), {"interval": "2us"}, "interval=", begin=0.0)
    yield File("grouped-rate.txt", interval_in_a_comment("Sample rate: 500,000.0 Hz").encode(), {"interval": "2us"}, "interval=", begin=0.0)
    yield File("blank-rate.txt", interval_in_a_comment("Sample rate: 500 000 Hz").encode(), begin=0.0)
    yield File("epoch.csv", ("Time [s],Force [N]\n" + "".join(f"1764324672.{1e7 * (t - BEGIN):07.0f},{f:.4f}\n"
               for t, f in zip(TIMES, FORCES))).encode(), begin=0.0)
    yield File("amplifier.csv", ("Sensitivity: 2.27 mV/N\nAmplifier gain: 10\ntime_us,force_V\n"
               + rows(1e6, 2.27e-2, force_format="{:.7f}")).encode(), {"scale": 0.1}, "gain")
    yield File("sensitivity-in-cells.csv", ("Sensitivity,2.27,mV/N\nTime (s),CH1 (V)\n"
               + rows(1, 2.27e-3, time_format="{:.6f}", force_format="{:.8f}")).encode())
    yield File("calibration.csv", ("Gain: 440.528634 N/V\nTime (s),CH1 (V)\n"
               + rows(1, 2.27e-3, time_format="{:.6f}", force_format="{:.8f}")).encode())
    volts = "Sensitivity: 2.27 mV/N\n{}\ntime_us,force_V\n" + rows(1e6, 2.27e-3, force_format="{:.8f}")
    for i, line in enumerate(("Amplifier: 480E09", "Amplifier serial number: 1234", "Gain: 0 dB", "Gain: 1", "Date: 2024.10.05")):
        yield File(f"amplifier-{i}.csv", volts.format(line).encode())
    yield File("gain.csv", volts.format("Amplifier: Kistler 5015\nGain: x10").encode(), {"scale": 1}, "gain")
    yield File("interval-in-cells.csv", ("Sample rate,500,kHz\nNr,Force (N)\n"
               + "".join(f"{i},{f:.4f}\n" for i, f in enumerate(FORCES))).encode(), begin=0.0)
    yield File("fortran.dat", ("t [us]  F [N]\n" + rows(1e6, 1, "  ", force_format="{:.6e}").replace("e+", "D+").replace("e-", "D-")).encode())
    yield File("blanks-without-a-cell.dat", ("time_ms  disp_mm  force_N  trig\n" + "".join(
        f"{1e3 * t:.4f} {'1.25' if i != 120 else '    '} {f:.5f} 7\n" for i, (t, f) in enumerate(zip(TIMES, FORCES)))).encode(), n=N - 1)
    yield File("rate.txt", interval_in_a_comment("Sampling rate [kHz]: 500").encode(), begin=0.0)
    yield File("no-interval.txt", interval_in_a_comment("channel 2").encode(), {"interval": "2us"}, "interval=", begin=0.0)
    yield File("sensitivity.csv", ("# Sensitivity: 2,27 mV/N\nt (ms);U (mV)\n" + rows(1e3, 2.27, ";", comma=True)).encode())
