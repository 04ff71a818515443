// Where the page takes a run from: out of itself, or from `fluidtex view`, which serves it while it goes on.

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

// In the page: each picture, mesh and video is an element of its own, in base64, so that it is decoded
// only when it is shown.
function embedded(run) {
  const textOf = (id) => document.getElementById(id).textContent;
  const video = run.video?.embedded
    ? URL.createObjectURL(new Blob([bytesOf(textOf('video'))], { type: 'video/mp4' }))
    : run.video && encodeURIComponent(run.video.name);
  return {
    live: false,
    run,
    picture: (frame) => `data:image/jpeg;base64,${textOf(`picture-${frame}`)}`,
    mesh: async (frame) => bytesOf(textOf(`mesh-${frame}`)),
    video: () => video,
    refresh: async () => false,
  };
}

async function get(address) {
  const answer = await fetch(address, { cache: 'no-store' });
  if (!answer.ok) throw new Error(await answer.text());
  return answer;
}

function served() {
  let text = '';
  const source = {
    live: true,
    run: null,
    picture: (frame) => `frames/${frame}.png`,
    mesh: async (frame) => new Uint8Array(await (await get(`mesh/${frame}`)).arrayBuffer()),
    video: () => `video?${source.run.video.bytes}`, // another address when it is written anew
    // Whether the run is another than at the last call.
    refresh: async () => {
      const now = await (await get('run')).text();
      if (now === text) return false;
      text = now;
      source.run = JSON.parse(now);
      return true;
    },
  };
  return source;
}

export async function openSource() {
  const run = document.getElementById('run');
  if (run) return embedded(JSON.parse(run.textContent));
  const source = served();
  await source.refresh();
  return source;
}
