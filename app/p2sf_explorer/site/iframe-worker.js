// Lets the search work where the site is opened from a folder: browsers start no Worker from file:, so that a frame takes its place.
(() => {
  if (location.protocol !== "file:") return;
  const start = `
    self.importScripts = (...urls) => Promise.all(urls.map((url) => new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = url; script.onload = resolve; script.onerror = reject;
      document.body.appendChild(script);
    })));
    self.postMessage = (data) => parent.dispatchEvent(new CustomEvent("frame-worker", {detail: {from: self, data}}));
  `;
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.appendChild(this.frame);
      const inside = this.frame.contentWindow;
      addEventListener("frame-worker", ({detail}) => {
        if (detail.from !== inside) return;
        const message = new MessageEvent("message", {data: detail.data});
        this.dispatchEvent(message);
        if (this.onmessage) this.onmessage(message);
      });
      this.ready = new Promise((resolve) => {
        const page = inside.document;
        page.open();
        page.write(`<!doctype html><body><script>${start}<\/script></body>`);
        page.close();
        const script = page.createElement("script");
        script.src = new URL(url, location.href);
        script.onload = resolve;
        page.body.appendChild(script);
      });
    }
    postMessage(data) {
      const inside = this.frame.contentWindow;
      this.ready.then(() => inside.dispatchEvent(new inside.MessageEvent("message", {data})));
    }
    terminate() {
      this.frame.remove();
    }
  };
})();
