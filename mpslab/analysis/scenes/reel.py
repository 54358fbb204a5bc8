"""Pictures one after the other, and the film files that they become."""

import io
import shutil
import subprocess
import tempfile
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

import numpy as np
from PIL import Image

from mpslab.core.files import in_words, replacing

# From best to smallest: the encoder's quality, and the share of the size in pixels.
RUNGS = {
    ".mp4": [(18, 1.0), (22, 1.0), (26, 1.0), (30, 1.0), (30, 0.75), (34, 0.75), (34, 0.5),
             (40, 0.5)],
    ".webp": [(88, 1.0), (75, 1.0), (60, 1.0), (40, 1.0), (60, 0.75), (40, 0.75), (40, 0.5),
              (15, 0.5)],
    ".gif": [(256, 1.0), (128, 1.0), (64, 1.0), (128, 0.75), (64, 0.75), (64, 0.5), (32, 0.5)],
}  # fmt: skip
MEGABYTE = 1_000_000
PALETTE_FROM = 6  # pictures


class Reel:
    """Pictures of one size, kept without loss in a file that is deleted with the reel.

    Used as a context manager; `append` adds a picture, iteration goes through them.
    """

    def __init__(self):
        self._file = tempfile.TemporaryFile()  # noqa: SIM115 (closed by __exit__)
        self._ends = [0]
        self.size = None

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self._file.close()

    def __len__(self):
        return len(self._ends) - 1

    def append(self, image):
        """Add a picture, (h, w, 3) uint8; ValueError if it has another size than the first."""
        height, width = image.shape[:2]
        if self.size not in (None, (width, height)):
            raise ValueError(f"picture of {width} x {height}: the others have {self.size}")
        self.size = width, height
        packed = io.BytesIO()
        Image.fromarray(image).save(packed, "PNG", compress_level=1)
        self._file.seek(self._ends[-1])
        self._file.write(packed.getbuffer())
        self._ends.append(self._file.tell())

    def __iter__(self):
        for begin, end in pairwise(self._ends):
            self._file.seek(begin)
            with Image.open(io.BytesIO(self._file.read(end - begin))) as picture:
                yield picture.convert("RGB")


def find_ffmpeg():
    """The program ffmpeg, of the system or of imageio-ffmpeg, a str; None if there is none."""
    found = shutil.which("ffmpeg")
    if found:
        return found
    try:
        import imageio_ffmpeg

        return imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        return None


def check_path(path):
    """The suffix of a film, which says its format; ValueError for one that cannot be written."""
    suffix = Path(path).suffix.lower()
    if suffix not in RUNGS:
        raise ValueError(f"--out {path}: suffix must be out of {', '.join(RUNGS)}")
    if suffix == ".mp4" and find_ffmpeg() is None:
        raise ValueError(
            f"--out {path}: there is no ffmpeg for .mp4; install it, pip install 'mpslab[film]', "
            "or take .webp or .gif"
        )
    return suffix


def write(reel, path, fps, limit=None):
    """Write a film; the file takes its name when it is whole.

    Parameters
    ----------
    reel : Reel
    path : str or Path
        With the suffix .mp4 (H.264), .webp or .gif (these two repeat without end).
    fps : float [1/s]
        Pictures a second; a GIF shows each for a whole number of hundredths of a second.
    limit : float, optional [MB]
        Quality, and then size in pixels, are lowered until the file is no larger.

    Returns
    -------
    size : int [bytes]
    rung : int
        How many times quality or size were lowered.

    Raises
    ------
    ValueError
        If the path has another suffix, or there is no ffmpeg.
    RuntimeError
        If ffmpeg fails, with what it said last.
    """
    suffix = check_path(path)
    encode = _encode_mp4 if suffix == ".mp4" else _encode_animation
    with replacing(path) as draft:
        for rung in range(len(RUNGS[suffix])):
            encode(reel, draft, suffix, fps, *RUNGS[suffix][rung])
            size = draft.stat().st_size
            if limit is None or size <= limit * MEGABYTE:
                break
    return size, rung


def told(path, size, rung, limit):
    """A line on a film that `write` has written."""
    line = f"{path}: {in_words(size)}"
    if limit is not None and size > limit * MEGABYTE:
        return f"{line} at the lowest quality and size, more than the limit of {limit:g} MB"
    return f"{line}, after quality or size were lowered {rung} times" if rung else line


def _scaled(reel, share):
    """The pictures with a share of their width and height, both even."""
    size = tuple(max(2 * round(0.5 * share * length), 2) for length in reel.size)
    for picture in reel:
        yield picture if picture.size == size else picture.resize(size, Image.Resampling.LANCZOS)


def _encode_mp4(reel, draft, suffix, fps, quality, share):
    pictures = _scaled(reel, share)
    first = next(pictures)
    command = [
        find_ffmpeg(), "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
        "-s", "{}x{}".format(*first.size), "-r", f"{fps:g}", "-i", "-", "-an", "-c:v", "libx264",
        "-preset", "medium", "-crf", str(quality), "-pix_fmt", "yuv420p",
        "-movflags", "+faststart", "-f", "mp4", str(draft),
    ]  # fmt: skip
    with _running(command) as pipe:
        pipe.write(np.asarray(first).tobytes())
        for picture in pictures:
            pipe.write(np.asarray(picture).tobytes())


@contextmanager
def _running(command):
    """The input of a process that must end well; RuntimeError with its last line if it does not."""
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=said, stderr=said)
        try:
            yield process.stdin
            process.stdin.close()
        except BrokenPipeError:
            pass
        except BaseException:
            process.kill()
            raise
        finally:
            status = process.wait()
        if status:
            said.seek(0)
            lines = said.read().decode(errors="replace").strip().splitlines() or ["no reason given"]
            raise RuntimeError(f"ffmpeg failed: {lines[-1]}")


def _encode_animation(reel, draft, suffix, fps, quality, share):
    pictures = _scaled(reel, share)
    options = {"save_all": True, "loop": 0}
    if suffix == ".webp":
        # Times are whole milliseconds: the end of each picture is rounded, and the length kept.
        options |= {"quality": quality, "method": 4, "duration": _durations(len(reel), 1e3 / fps)}
    else:
        options |= {"duration": max(10 * round(100 / fps), 20), "disposal": 1}
        palette = _palette(reel, quality)
        pictures = (p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures)
        next(pictures).save(draft, "GIF", append_images=pictures, **options)
        return
    next(pictures).save(draft, "WEBP", append_images=pictures, **options)


def _palette(reel, colours):
    """One palette for all pictures, from some of them side by side."""
    some = set(np.linspace(0, len(reel) - 1, PALETTE_FROM).astype(int).tolist())
    seen = [np.asarray(picture) for number, picture in enumerate(reel) if number in some]
    return Image.fromarray(np.concatenate(seen, axis=1)).quantize(colours)


def _durations(count, each):
    ends = np.round(each * np.arange(count + 1)).astype(int)
    return np.diff(ends).tolist()
