// The page of the results that it has.

new Page(JSON.parse(element("description").textContent)).start();
