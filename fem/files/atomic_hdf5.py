"""HDF5 files that are written aside, on a disk that may fill up.

HDF5 keeps a file open that it could not write to its end, and brings the process down
with it. It therefore writes through a file object of ours that refuses nothing: the
first error of the system is kept, what comes after it goes nowhere, and the error is
raised when HDF5 has closed what is to be thrown away.
"""

import _thread
import io
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py

from fem.files.atomic import written_aside

_LATER = 0.05  # s
_DESCRIPTION = 1 << 20  # bytes: what HDF5 reads again is no larger


@contextmanager
def written_hdf5(path: Path) -> Iterator[h5py.File]:
    """A new HDF5 file that takes its name when it is complete, see `written_aside`.

    Raises:
        OSError: it could not be written; names the file itself.
    """
    with written_aside(path) as part, io.FileIO(part, "r+") as stream:
        disk = _Disk(stream)
        file = h5py.File(disk, "w")
        try:
            yield file
        finally:
            file.close()
            if disk.error is not None:
                raise disk.error from None


class _Disk(io.RawIOBase):
    """What h5py's driver for file objects asks for.

    Attributes:
        error: the first of the system, or Ctrl-C; None while all is well.
    """

    def __init__(self, stream: io.FileIO) -> None:
        super().__init__()
        self._stream = stream
        self.error: OSError | KeyboardInterrupt | None = None
        self._after: dict[int, bytes] = {}  # what came after the error, by place

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """See `io.IOBase`."""
        return self._stream.seek(offset, whence)

    def tell(self) -> int:
        """See `io.IOBase`."""
        return self._stream.tell()

    def readinto(self, buffer: memoryview) -> int:
        """Fills the whole buffer, with zeros beyond the end of the file."""
        view = memoryview(buffer).cast("B")
        kept = self._after.get(self._stream.tell(), b"")
        if len(kept) >= len(view):
            view[:] = kept[: len(view)]
            return len(view)
        done = 0
        while done < len(view):
            count = self._stream.readinto(view[done:])
            if not count:
                view[done:] = bytes(len(view) - done)
                break
            done += count
        return len(view)

    def write(self, data: memoryview) -> int:
        """Writes all of the data."""
        view, start = memoryview(data).cast("B"), self._stream.tell()
        size = len(view)
        try:
            while len(view) and self.error is None:
                view = view[self._stream.write(view) :]
        except (OSError, KeyboardInterrupt) as error:
            self._keep(error)
        if self.error is not None and size <= _DESCRIPTION:
            self._after[start] = bytes(data)
        return size

    def truncate(self, size: int) -> int:
        """The file has a size from now on."""
        try:
            if self.error is None:
                self._stream.truncate(size)
        except (OSError, KeyboardInterrupt) as error:
            self._keep(error)
        return size

    def flush(self) -> None:
        """Nothing is held back."""

    def _keep(self, error: OSError | KeyboardInterrupt) -> None:
        """HDF5 must not see it; the program shall see Ctrl-C again, a little later."""
        self.error = error
        if isinstance(error, KeyboardInterrupt):
            threading.Timer(_LATER, _thread.interrupt_main).start()
