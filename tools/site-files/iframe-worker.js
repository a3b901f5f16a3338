// Browsers start no worker from file://. There a hidden frame runs its script instead, so that the search works from a folder.
if (location.protocol === "file:") {
    window.Worker = class extends EventTarget {
        constructor(address) {
            super();
            this.frame = document.createElement("iframe");
            this.frame.hidden = true;
            this.frame.worker = this;
            this.frame.srcdoc = `<script>
                postMessage = (data) => frameElement.worker.dispatchEvent(new MessageEvent("message", { data }));
            <\/script><script src="${address}"><\/script>`;
            this.ready = new Promise((resolve) => this.frame.addEventListener("load", resolve));
            document.body.append(this.frame);
        }

        postMessage(data) {
            this.ready.then(() => this.frame.contentWindow.dispatchEvent(new MessageEvent("message", { data })));
        }
    };
}
