"""`p2sf cluster`: how to render a stack or a picture on many machines, and who works for a scheduler."""

from p2sf.cli.options import Json
from p2sf.cli.screen import print_json, print_table
from p2sf.version import program_version

ADDRESS = "tcp://FIRST:8786"
TOLD = """A stack of PSFs, or a picture, on many machines

on one of them, called FIRST here:   {scheduler}
on each of them:                     {worker}

Both come with pip install 'p2sf[dask]', for which all machines need p2sf {version}. Then

    p2sf cluster {address}
    p2sf database build LENS --stack --scheduler {address} -o PLACE
    p2sf image LENS SCENE PICTURE --scheduler {address} -o FILE

where PLACE ends in .zarr and is a folder that all machines share, or a URL, such as s3://bucket/name.zarr: workers
write to it themselves, each with its own machine's credentials. Once stopped, by whatever, the same command continues.
Who reaches a scheduler can run any program on its workers: start it in a network that you trust."""


def cluster(address: str | None = None, /, *, as_json: Json = False) -> None:
    """Tell how to use many machines for a stack or a picture; with a scheduler's address, list its workers.

    Parameters
    ----------
    address
        Address of a dask.distributed scheduler, such as tcp://192.168.0.2:8786.
    """
    if address is None:
        return _tell_how(as_json)
    from p2sf.cluster import check_versions, connect, worker_versions

    with connect(address) as client:
        versions = worker_versions(client, address)
        threads = client.nthreads()
    check_versions(versions)
    rows = [(worker, threads.get(worker, 0), str(version)) for worker, version in versions.items()]
    if as_json:
        return print_json({"workers": [dict(zip(("address", "threads", "p2sf"), row, strict=True)) for row in rows]})
    return print_table(f"Workers of {address}", ("address", "threads", "P2SF"), rows)


def _tell_how(as_json: bool) -> None:
    from p2sf.cluster import SCHEDULER, WORKER

    lines = {"scheduler": SCHEDULER, "worker": WORKER.format(address=ADDRESS)}
    if as_json:
        return print_json(lines)
    return print(TOLD.format(**lines, version=program_version(), address=ADDRESS))
